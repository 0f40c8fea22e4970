// The `state` of the application and of who controls it, as everybody sees it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/executive/executive.hpp"
#include "runtime/face/directory.hpp"
#include "runtime/face/statistics.hpp"
#include "web-ui/server/access.hpp"
#include "web-ui/server/api/edit_operations.hpp"
#include "web-ui/server/server_figures.hpp"

namespace flexrf::panel {

/// The server's thread. The text is made once per change for all; it differs only for whom it calls "you".
class StateEvent {
 public:
  static constexpr Duration interval = std::chrono::seconds{1};
  static constexpr Duration beside_values = std::chrono::milliseconds{7};

  StateEvent(Executive& executive, const Directory& directory, const AccessControl& access,
             const EditOperations& edits)
      : executive_(&executive),
        directory_(&directory),
        access_(&access),
        edits_(&edits),
        places_(executive.cell()),
        faults_(places_.count()) {
    for (std::string& text : texts_) text.reserve(usual_size);
  }

  void set_figures(const ServerFigures& figures) noexcept { figures_ = figures; }
  /// Makes it anew when something changed, and once in each second.
  void update(Time now);
  /// Rises when it was made anew; 0: never.
  std::uint64_t version() const noexcept { return version_; }
  Time next() const noexcept { return next_; }
  /// The whole event.
  std::string_view event_for(SessionIndex session) const noexcept;
  /// The same without "event", but for the bracket that opens it.
  std::string_view members_for(SessionIndex session) const noexcept;

 private:
  /// Bytes of a text in which much is told.
  static constexpr std::size_t usual_size = 4U << 10;

  struct Fault {
    std::int64_t extent = 0;  ///< 0: none; of a standstill, ns
    Time since{};
  };

  void note_faults(Time now) noexcept;
  std::uint64_t signature() const noexcept;
  void write(std::string& text, SessionIndex you, Time now) const;
  void write_session(JsonWriter& json, SessionIndex session, SessionIndex you) const;
  void write_faults(JsonWriter& json) const;
  void write_values(JsonWriter& json) const;

  Executive* executive_;
  const Directory* directory_;
  const AccessControl* access_;
  const EditOperations* edits_;
  ServerFigures figures_;
  std::uint64_t version_ = 0;
  std::uint64_t seen_ = 0;
  Time next_{};
  SessionIndex holder_ = no_session;
  SessionIndex wanted_by_ = no_session;
  SessionIndex editor_ = no_session;
  // For the holder, for who asks for control, for everybody else.
  std::array<std::string, 3> texts_;
  FaultPlaces places_;
  std::vector<Fault> faults_;  // in each place
};

}  // namespace flexrf::panel
