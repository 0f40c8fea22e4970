#include "web-ui/server/api/tests/rig.hpp"

#include <algorithm>
#include <utility>

namespace flexrf::panel {

using fixture::CheckFailed;

// ---- access

PlayedAccess::PlayedAccess() : ended_(session_count) {
  sessions_ = {{"panel-1", "", "127.0.0.1", Role::viewer, true},
               {"panel-2", "olga", "127.0.0.1", Role::operator_, true},
               {"panel-3", "eric", "127.0.0.1", Role::engineer, true},
               {"panel-4", "erna", "127.0.0.1", Role::engineer, true},
               {"panel-5", "adam", "192.168.0.7", Role::admin, false}};
}

const SessionInfo* PlayedAccess::session(SessionIndex index) const {
  return index < session_count && !ended_[index] ? &sessions_[index] : nullptr;
}

bool PlayedAccess::has_role(SessionIndex index, Role role) const {
  const SessionInfo* const info = session(index);
  return info != nullptr && info->role >= role;
}

void PlayedAccess::give(SessionIndex to) {
  const SessionIndex from = holder_;
  holder_ = to;
  wanted_by_ = no_session;
  ++revision_;
  if (watcher != nullptr && from != to) watcher->on_control_changed(from, to);
}

void PlayedAccess::lapse(SessionIndex index) {
  sessions_[index].lapsed = true;
  sessions_[index].role = Role::viewer;
  if (holder_ == index) give(no_session);
  ++revision_;
}

void PlayedAccess::end(SessionIndex index) {
  ended_[index] = true;
  if (holder_ == index) give(no_session);
  ++revision_;
  watcher->on_session_ended(index);
}

AccessControl::Taking PlayedAccess::take(SessionIndex index, Time) {
  if (!has_role(index, Role::operator_)) return Taking::refused_role;
  if (holder_ == no_session || holder_ == index) {
    give(index);
    return Taking::taken;
  }
  if (wanted_by_ != no_session && wanted_by_ != index) return Taking::refused_asked;
  wanted_by_ = index;
  ++revision_;
  return Taking::asked;
}

void PlayedAccess::release(SessionIndex index) {
  if (holder_ == index) give(wanted_by_);
}

bool PlayedAccess::answer(SessionIndex index, bool grant, Time) {
  if (holder_ != index || wanted_by_ == no_session) return false;
  if (grant) {
    give(wanted_by_);
  } else {
    wanted_by_ = no_session;
    ++revision_;
  }
  return true;
}

// ---- links and replies

std::string& PlayedLink::buffer() {
  if (writing_) throw CheckFailed{"a buffer was asked for while the last message is under way"};
  buffer_.clear();
  return buffer_;
}

void PlayedLink::begin_to_send() {
  if (writing_ || closed != 0)
    throw CheckFailed{"sent while the last message is under way, or after the end"};
  ++sent;
  if (stuck) writing_ = true;
}

void PlayedLink::send_shared(std::span<char> memory) {
  begin_to_send();
  if (memory.size() < head_room) throw CheckFailed{"no room for the frame's head"};
  if (keep) frames.emplace_back(memory.data() + head_room, memory.size() - head_room);
  // As a link does; whoever shares it has to bear that.
  std::fill_n(memory.data(), head_room, '\xAA');
}

void PlayedLink::send(bool binary) {
  begin_to_send();
  if (!keep) return;
  if (binary) {
    frames.push_back(buffer_);
  } else {
    texts.push_back(json::parse(buffer_));
  }
}

void PlayedLink::close(std::uint16_t code, std::string_view reason) {
  closed = code;
  close_reason = reason;
}

void PlayedLink::unstick(Api& api) {
  stuck = writing_ = false;
  api.live().on_writable(*this);
}

Reply* PlayedReplies::reply_of(Ticket ticket) {
  const auto found = waiting.find(ticket.exchange);
  return found == waiting.end() ? nullptr : &found->second;
}

// ---- the rig

Rig::Rig(fixture::TestApplication& application, const ApiTimeouts& timeouts, Options options,
         std::string helper)
    : running_(application, std::move(options)),
      api_(running_.executive(), access_, replies_, places, timeouts, &bell_, std::move(helper)) {
  Status status = api_.prepare();
  if (status) status = api_.start();
  if (!status) throw CheckFailed{std::string{"the API: "} + status.cause()};
  access_.watcher = &api_;
}

Rig::~Rig() {
  access_.watcher = nullptr;
  // Its threads answer until they have ended: the API outlives them.
  if (started_) running_.finish();
  api_.stop();
}

void Rig::start() {
  running_.start();
  started_ = true;
  tick();  // it may have begun to after the last one: who connects now is told that it runs
}

PlayedLink& Rig::connect(SessionIndex session) {
  const auto place = std::find(connected_.begin(), connected_.end(), false);
  *place = true;
  PlayedLink& link = links_.emplace_back(static_cast<std::uint32_t>(place - connected_.begin()), session);
  api_.live().on_open(link);
  return link;
}

void Rig::disconnect(PlayedLink& link) {
  connected_[link.place()] = false;
  api_.live().on_close(link);
}

json Rig::ask(PlayedLink& link, json message) {
  const std::uint64_t id = ++id_;
  message["id"] = id;
  send(link, message);
  json answer;
  const bool came = wait_until([&] {
    const auto found = std::find_if(link.texts.begin(), link.texts.end(), [id](const json& text) {
      return text.value("id", std::uint64_t{0}) == id;
    });
    if (found == link.texts.end()) return false;
    answer = *found;
    link.texts.erase(found);
    return true;
  });
  if (!came) throw CheckFailed{"no answer to " + message.dump()};
  return answer;
}

json Rig::event(PlayedLink& link, const std::string& name) {
  json event;
  const bool came = wait_until([&] {
    const auto found = std::find_if(link.texts.begin(), link.texts.end(),
                                    [&name](const json& text) { return text.value("event", "") == name; });
    if (found == link.texts.end()) return false;
    event = *found;
    link.texts.erase(found);
    return true;
  });
  if (!came) throw CheckFailed{"no event " + name};
  return event;
}

Answer Rig::request(Method method, const std::string& path, SessionIndex session, const std::string& body,
                    const std::string& if_match, const std::string& if_none_match, const std::string& query,
                    const std::string& content_type) {
  const std::string whole = "/api/v1/" + path;
  Request request;
  request.local_end = *Address::parse("10.0.2.16");
  request.method = method;
  request.path = whole;
  request.query = query;
  request.body = body;
  request.content_type = body.empty() ? std::string_view{} : std::string_view{content_type};
  request.if_match = if_match;
  request.if_none_match = if_none_match;
  request.session = session;
  const std::uint32_t exchange = ++exchange_;
  Reply& reply = replies_.waiting[exchange];
  if (api_.handle(request, reply, {0, exchange}) == Handled::later) {
    const bool came = wait_until([&] {
      return std::find(replies_.completed.begin(), replies_.completed.end(), exchange) !=
             replies_.completed.end();
    });
    if (!came) throw CheckFailed{"no answer to " + whole};
  }
  Answer answer;
  answer.status = reply.status;
  answer.reply = reply;
  const std::string_view text = reply.fixed.empty() ? std::string_view{reply.text} : reply.fixed;
  if (reply.content_type.find("json") != std::string_view::npos && !text.empty())
    answer.body = json::parse(text);
  replies_.waiting.erase(exchange);
  return answer;
}

}  // namespace flexrf::panel
