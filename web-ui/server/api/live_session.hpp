// The live connection: texts that come in, and what goes out next.
#pragma once

#include <string_view>

#include "web-ui/server/api/frame_writer.hpp"
#include "web-ui/server/api/operations.hpp"
#include "web-ui/server/api/state_event.hpp"
#include "web-ui/server/api/topic_bodies.hpp"

namespace flexrf::panel {

/// What a live session is made of; all outlive it.
struct LiveParts {
  Executive& executive;
  AccessControl& access;
  Clients& clients;
  JsonReader& reader;
  Operations& operations;
  const StateEvent& state;
  TopicBodies& topics;
  FrameWriter& frames;
  std::string_view boot;
  bool has_machine = false;  ///< the application runs on a PC that it can tell of
};

/// The server's thread.
class LiveSession final : public LiveService {
 public:
  explicit LiveSession(const LiveParts& parts) noexcept : parts_(parts) {}

  void on_open(LiveLink& link) override;
  void on_text(LiveLink& link, std::string_view text) override;
  void on_writable(LiveLink& link) override;
  void on_close(LiveLink& link) override;

  /// Sends each client what it is due, until `deadline`; then goes on with the next one the next time.
  void send_all(Time now, Time deadline);
  Time next(Time now) const noexcept;
  /// Closes what is connected as this session.
  void close_session(SessionIndex session);

 private:
  void pump(Client& client, Time now);
  bool write_text(Client& client, Time now, std::string& to);
  bool write_topic(Client& client, Time now, std::string& to);
  bool write_log(Client& client, Time now, std::string& to);
  void write_hello(Client& client, Time now, std::string& to);
  void write_end(std::string& to);
  void close(Client& client, std::uint16_t code, std::string_view reason);

  LiveParts parts_;
  std::size_t turn_ = 0;  // who comes first
};

}  // namespace flexrf::panel
