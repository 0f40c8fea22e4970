// The live connection: texts that come in, and what goes out next.
#pragma once

#include <string_view>

#include "runtime/json/json_reader.hpp"
#include "web-ui/server/api/clients.hpp"
#include "web-ui/server/api/frame_writer.hpp"
#include "web-ui/server/api/operations.hpp"
#include "web-ui/server/api/state_event.hpp"
#include "web-ui/server/api/subscriptions.hpp"
#include "web-ui/server/api/topic_bodies.hpp"

namespace flexrf::panel {

/// What a live session is made of; all outlive it.
struct LiveParts {
  Executive& executive;
  AccessControl& access;
  Clients& clients;
  JsonReader& reader;
  Operations& operations;
  Subscriptions& subscriptions;
  const StateEvent& state;
  TopicBodies& topics;
  FrameWriter& frames;
  std::string_view boot;
};

/// The server's thread.
class LiveSession {
 public:
  explicit LiveSession(const LiveParts& parts) noexcept : parts_(parts) {}

  void on_open(LiveLink& link);
  void on_text(LiveLink& link, std::string_view text);
  void on_writable(LiveLink& link);
  void on_close(LiveLink& link);

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
  void operate(Client& client, const Caller& caller, std::string_view op, Fields& fields, Time now);
  void operate_on_component(const Caller& caller, std::string_view op, Fields& fields, Time now);
  /// False: the first of the fields that is wrong was answered.
  bool is_right(const Caller& caller, std::string_view op, const Fields& fields);
  void set(const Caller& caller, ComponentIndex component, Fields& fields, Time now);
  void close(Client& client, std::uint16_t code, std::string_view reason);

  LiveParts parts_;
  std::size_t turn_ = 0;  // who comes first
};

}  // namespace flexrf::panel
