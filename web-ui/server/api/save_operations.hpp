// Save now: what was set goes into the configuration file.
#pragma once

#include "runtime/executive/executive.hpp"
#include "web-ui/server/api/answers.hpp"
#include "web-ui/server/api/places.hpp"

namespace flexrf::panel {

/// Asks the runtime, which writes in a thread of its own, and answers its caller when it is done. The
/// server's thread.
class SaveOperations {
 public:
  SaveOperations(Executive& executive, Answers& answers, Permission& permission) noexcept
      : executive_(&executive), answers_(&answers), permission_(&permission) {}

  void save(const Caller& caller, Time now);
  void tick(Time now);

 private:
  /// A disk may be slow; one that says nothing for so long hangs.
  static constexpr Duration patience = std::chrono::seconds{10};

  struct Waiting {
    Caller caller;
    std::uint64_t number = 0;
    Time overdue_at{};
  };
  void answer(const Caller& caller, const SaveState& state);

  Executive* executive_;
  Answers* answers_;
  Permission* permission_;
  Places<Waiting, 8> waiting_;
};

}  // namespace flexrf::panel
