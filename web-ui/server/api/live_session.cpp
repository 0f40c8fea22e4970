#include "web-ui/server/api/live_session.hpp"

#include <algorithm>

#include "base/quantity_text.hpp"
#include "runtime/realtime/realtime_scope.hpp"
#include "web-ui/server/api/log_lines.hpp"

namespace flexrf::panel {
namespace {

/// RFC 6455, 7.4.1.
enum : std::uint16_t { close_no_text = 1007, close_violation = 1008, close_later = 1013 };

/// Of one client before the others have their turn.
constexpr int messages_per_turn = 16;

void write_session(JsonWriter& json, const SessionInfo& info) {
  json.begin_object().member("name", info.name).member("role", name_of(info.role));
  json.member("local", info.local).member("user", info.user).member("lapsed", info.lapsed).end_object();
}

}  // namespace

// ---- connections

void LiveSession::on_open(LiveLink& link) {
  const Time now = MonotonicClock::now();
  parts_.access.link_opened(link.session());
  pump(parts_.clients.open(link, now), now);
}

void LiveSession::on_close(LiveLink& link) {
  Client& client = parts_.clients.at(link.place());
  if (client.link != &link) return;
  const Time now = MonotonicClock::now();
  parts_.operations.parameters.end_holds_of_client(link.place(), now);
  if (client.session != no_session) parts_.access.link_closed(client.session, now);
  parts_.clients.close(client);
  parts_.operations.subscriptions.update_demand();
}

void LiveSession::on_writable(LiveLink& link) {
  Client& client = parts_.clients.at(link.place());
  if (client.link != &link || client.pumping) return;
  parts_.frames.begin_turn();
  pump(client, MonotonicClock::now());
}

void LiveSession::close(Client& client, std::uint16_t code, std::string_view reason) {
  if (!client.is_open()) return;
  // What it holds ends now, not when the socket does.
  client.closing = true;
  LiveLink* const link = client.link;
  parts_.operations.parameters.end_holds_of_client(link->place(), MonotonicClock::now());
  link->close(code, reason);
}

void LiveSession::close_session(SessionIndex session) {
  for (Client& client : parts_.clients.all()) {
    if (client.link == nullptr || client.session != session) continue;
    close(client, close_violation, "the session has ended");
    // The index may be another's soon.
    client.session = no_session;
  }
}

// ---- what comes in

void LiveSession::on_text(LiveLink& link, std::string_view text) {
  Client& client = parts_.clients.at(link.place());
  if (client.link != &link || client.closing) return;
  const Time now = MonotonicClock::now();
  parts_.frames.begin_turn();
  const Result<JsonObject> object = parts_.reader.object(text);
  if (!object) return close(client, close_no_text, object.status().cause());
  Fields fields(*object);
  const std::string_view op = fields.text("op");
  const std::uint64_t id = fields.integer("id");
  if (!fields.status() || id == 0)
    return close(client, close_violation, "a message has an 'op' and an 'id' above 0");
  Caller caller;
  caller.kind = Caller::Kind::live;
  caller.session = client.session;
  caller.place = link.place();
  caller.opening = client.opening;
  caller.id = id;
  const Operation* const operation = find_operation(op);
  if (operation == nullptr || operation->is_an_act) parts_.access.acted(client.session, now);
  if (operation == nullptr) {
    parts_.operations.answers.refuse(caller, no_operation(op));
  } else {
    Asked asked{parts_.operations, caller, fields, op, now};
    operation->run(asked);
  }
  if (client.is_open() && client.outbox.is_full())
    return close(client, close_later, "too many answers wait to be read");
  pump(client, now);
}

// ---- what goes out

void LiveSession::send_all(Time now, Time deadline) {
  const std::size_t count = parts_.clients.all().size();
  for (std::size_t i = 0; i < count; ++i) {
    Client& client = parts_.clients.all()[turn_];
    turn_ = (turn_ + 1) % count;
    if (!client.is_open()) continue;
    if (client.outbox.is_full()) {
      close(client, close_later, "too many answers wait to be read");
      continue;
    }
    pump(client, now);
    if (i % 8 == 7 && MonotonicClock::now() > deadline) return;
  }
}

Time LiveSession::next(Time now) const noexcept {
  Time next = now + std::chrono::milliseconds{100};
  for (const Client& client : parts_.clients.all()) {
    // Who is being written to comes by itself when that is done.
    if (!client.is_open() || client.link->is_writing()) continue;
    if (!client.outbox.is_empty() || client.state_seen != parts_.state.version()) return now;
    next = std::min(next, FrameWriter::next(client));
    for (const TopicSubscription& topic : client.topics) {
      if (topic.interval.count() > 0) next = std::min(next, topic.next);
    }
  }
  return next;
}

void LiveSession::pump(Client& client, Time now) {
  client.pumping = true;
  for (int i = 0; i < messages_per_turn && client.is_open() && !client.link->is_writing(); ++i) {
    if (write_text(client, now, client.link->buffer())) {
      client.link->send(false);
      continue;
    }
    const std::span<char> frame = parts_.frames.write(client, now);
    if (!frame.empty()) client.link->send_shared(frame);
    break;  // it had all that is due
  }
  client.pumping = false;
}

bool LiveSession::write_text(Client& client, Time now, std::string& to) {
  if (!client.greeted) {
    write_hello(client, now, to);
    client.greeted = true;
    return true;
  }
  if (!client.outbox.is_empty()) {
    client.outbox.take(to);
    return true;
  }
  if (const SessionInfo* const info = parts_.access.session(client.session);
      info != nullptr && info->lapsed && !client.told_of_lapse) {
    client.told_of_lapse = true;
    JsonWriter json(std::move(to));
    json.begin_object().member("event", "session").key("session");
    write_session(json, *info);
    json.end_object();
    to = json.release();
    return true;
  }
  if (client.state_seen != parts_.state.version()) {
    to += parts_.state.event_for(client.session);
    client.state_seen = parts_.state.version();
    return true;
  }
  if (!client.told_of_end && parts_.executive.control().mode() >= Mode::safe) {
    client.told_of_end = true;
    write_end(to);
    return true;
  }
  return write_topic(client, now, to) || write_log(client, now, to);
}

bool LiveSession::write_topic(Client& client, Time now, std::string& to) {
  for (std::size_t i = 0; i < topic_count; ++i) {
    const auto topic = static_cast<Topic>(i);
    TopicSubscription& subscription = client.topics[i];
    if (topic == Topic::log || subscription.interval.count() == 0 || now < subscription.next) continue;
    subscription.next = now + subscription.interval;
    const std::string_view body = parts_.topics.body(topic, now);
    if (parts_.topics.version(topic) == subscription.seen) continue;
    subscription.seen = parts_.topics.version(topic);
    constexpr std::size_t around = 64;
    to.reserve(parts_.topics.room(topic) + around);
    to.append(R"({"event":"topic","name":")").append(name_of(topic)).append(R"(","body":)");
    to.append(body).append("}");
    return true;
  }
  return false;
}

bool LiveSession::write_log(Client& client, Time now, std::string& to) {
  TopicSubscription& log = client.topics[static_cast<std::size_t>(Topic::log)];
  if (log.interval.count() == 0 || now < log.next) return false;
  log.next = now + log.interval;
  if (last_log_line() == log.seen) return false;
  JsonWriter json(std::move(to));
  json.begin_object().member("event", "log").key("lines");
  log.seen = write_log_lines(json, log.seen);
  json.end_object();
  to = json.release();
  return true;
}

void LiveSession::write_hello(Client& client, Time now, std::string& to) {
  const Application& application = parts_.executive.cell().application();
  const SessionInfo* const session = parts_.access.session(client.session);
  constexpr SessionInfo nobody{};
  const SessionInfo& info = session == nullptr ? nobody : *session;
  JsonWriter json(std::move(to));
  json.begin_object().member("event", "hello").member("protocol", 1).member("application", application.name);
  json.member("boot", parts_.boot).member("descriptor", hexadecimal_text(application.descriptor_hash));
  json.key("drivers").begin_object();
  for (const DeviceRecord& device : application.devices)
    json.member(device.name, parts_.executive.cell().driver_name(device.index));
  json.end_object();
  json.key("null_reasons").begin_array();
  for (std::size_t reason = 0; reason < null_reason_count; ++reason)
    json.value(name_of(static_cast<NullReason>(reason)));
  json.end_array().key("session");
  write_session(json, info);
  json.member("server_time_ns", nanoseconds(now)).member("allocations", has_allocation_guard());
  json.member("machine", parts_.has_machine).end_object();
  to = json.release();
}

void LiveSession::write_end(std::string& to) {
  JsonWriter json(std::move(to));
  json.begin_object().member("event", "ended").member("text", "The application has come to its end");
  json.member("cause", name_of(parts_.executive.control().cause())).end_object();
  to = json.release();
}

}  // namespace flexrf::panel
