// A running cell with the panel's API over it; the test plays sockets, sessions and people.
#pragma once

#include <simdjson.h>  // before CMocka, whose macros are in its way

#include <deque>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "runtime/executive/tests/running_cell.hpp"
#include "web-ui/server/api/api.hpp"

namespace flexrf::panel {

using nlohmann::json;

/// Sessions that there are from the beginning, by role; none holds control.
enum : SessionIndex { a_viewer, an_operator, an_engineer, another_engineer, an_admin, session_count };

class PlayedAccess final : public AccessControl {
 public:
  PlayedAccess();

  const SessionInfo* session(SessionIndex index) const override;
  bool has_role(SessionIndex index, Role role) const override;
  SessionIndex holder() const override { return holder_; }
  SessionIndex wanted_by() const override { return wanted_by_; }
  Duration answer_within(Time) const override { return std::chrono::seconds{7}; }
  Taking take(SessionIndex index, Time now) override;
  void release(SessionIndex index) override;
  bool answer(SessionIndex index, bool grant, Time now) override;
  std::uint64_t revision() const override { return revision_; }
  void link_opened(SessionIndex) override { ++links; }
  void link_closed(SessionIndex, Time) override { --links; }
  void acted(SessionIndex, Time) override { ++acts; }

  void give(SessionIndex to);
  void end(SessionIndex index);
  void lapse(SessionIndex index);
  int acts = 0;
  int links = 0;
  AccessWatcher* watcher = nullptr;

 private:
  std::vector<SessionInfo> sessions_;
  std::vector<bool> ended_;
  SessionIndex holder_ = no_session;
  SessionIndex wanted_by_ = no_session;
  std::uint64_t revision_ = 1;
};

/// What was sent stays until the test takes it. A stuck link's client reads nothing.
class PlayedLink final : public LiveLink {
 public:
  PlayedLink(std::uint32_t place, SessionIndex session) : place_(place), session_(session) {
    buffer_.reserve(room);
  }

  /// Bytes that a real connection has for a message, or a reply, from the beginning.
  static constexpr std::size_t room = 4U << 10;

  std::uint32_t place() const override { return place_; }
  SessionIndex session() const override { return session_; }
  bool is_writing() const override { return writing_; }
  std::string& buffer() override;
  void send(bool binary) override;
  void send_shared(std::span<char> memory) override;
  void close(std::uint16_t code, std::string_view reason) override;

  bool stuck = false;
  bool keep = true;  ///< what is sent; else it is only counted
  std::size_t sent = 0;
  std::deque<json> texts;
  std::deque<std::string> frames;
  std::uint16_t closed = 0;
  std::string close_reason;
  void unstick(Api& api);

 private:
  std::uint32_t place_;
  SessionIndex session_;
  void begin_to_send();

  bool writing_ = false;
  std::string buffer_;
};

class PlayedReplies final : public LaterReplies {
 public:
  Reply* reply_of(Ticket ticket) override;
  void complete(Ticket ticket) override { completed.push_back(ticket.exchange); }

  std::map<std::uint32_t, Reply> waiting;
  std::vector<std::uint32_t> completed;
};

struct Answer {
  unsigned status = 0;
  json body;
  Reply reply;
};

class Rig {
 public:
  static constexpr std::uint32_t places = 8;
  /// Which nothing but a hang exceeds: a thread of a loaded machine may be kept from its work for seconds.
  static constexpr ApiTimeouts patient{std::chrono::minutes{1}, std::chrono::minutes{1}};

  explicit Rig(fixture::TestApplication& application, const ApiTimeouts& timeouts = patient,
               Options options = fixture::on_the_wall_clock(), std::string helper = {});
  ~Rig();

  /// Runs until the application does.
  void start();
  Executive& executive() { return running_.executive(); }
  Api& api() { return api_; }
  PlayedAccess& access() { return access_; }
  PlayedReplies& replies() { return replies_; }
  /// What other threads ring when they have answered. The rig looks often enough without it.
  Doorbell& bell() { return bell_; }
  void tick() { tick(MonotonicClock::now()); }
  void tick(Time now) { api_.on_tick(now); }
  template <class Condition>
  bool wait_until(Condition condition) {
    return test::wait_until([&] {
      tick();
      return condition();
    });
  }

  PlayedLink& connect(SessionIndex session);
  void disconnect(PlayedLink& link);
  void send(PlayedLink& link, const json& message) { api_.live().on_text(link, message.dump()); }
  /// Sends with an id of its own, and waits for the answer.
  json ask(PlayedLink& link, json message);
  /// Waits for the next event of this name.
  json event(PlayedLink& link, const std::string& name);

  Answer request(Method method, const std::string& path, SessionIndex session, const std::string& body = "",
                 const std::string& if_match = "", const std::string& if_none_match = "",
                 const std::string& query = "", const std::string& content_type = "application/json");
  Answer get(const std::string& path, SessionIndex session = a_viewer) {
    return request(Method::get, path, session);
  }

 private:
  PlayedAccess access_;
  PlayedReplies replies_;
  fixture::RunningCell running_;
  Doorbell bell_;
  Api api_;
  std::deque<PlayedLink> links_;
  std::vector<bool> connected_ = std::vector<bool>(places);
  bool started_ = false;
  std::uint32_t exchange_ = 0;
  std::uint64_t id_ = 0;
};

}  // namespace flexrf::panel
