#include "units/remote_control/remote_control.hpp"

#include <algorithm>

#include "runtime/log/log.hpp"
#include "runtime/parameters/value_access.hpp"
#include "units/remote_control/remote_change.hpp"

namespace flexrf::user {

using remote::RpcError;
using remote::RpcProblem;

Status RemoteControl::initialise() {
  clients_.clear();
  waiting_.clear();
  saves_.clear();
  view_.emplace(cell.cell());
  token_.forget();
  const std::string file(configuration.token_file_view());
  if (!file.empty()) {
    if (const Status status = token_.load(file.c_str()); !status) return status;
  }
  return look_at_the_door();
}

void RemoteControl::stop() {
  token_.forget();
  clients_.clear();
  waiting_.clear();
  saves_.clear();
}

Status RemoteControl::look_at_the_door() {
  const ParameterBlock& block = door->type_in_force().configuration;
  const void* const values = door->parameter_memory().configuration;
  const auto text = [&](const char* name) {
    const Result<FieldPlace> place = find_field(*block.type, name);
    return place ? text_of(*place, values) : std::string{};
  };
  const std::string address = text("address");
  if (text("listen") != "true") {
    return Status::error(StatusCode::invalid_argument,
                         "device %s does not listen; set its configuration.listen = true", door->name());
  }
  const Result<FieldPlace> buffer = find_field(*block.type, "buffer");
  const Result<double> bytes = buffer ? read_number(*buffer, values) : Result<double>{0.0};
  buffer_ = bytes ? static_cast<std::size_t>(*bytes) : 0;
  if (buffer_ < smallest_buffer) {
    return Status::error(StatusCode::invalid_argument,
                         "device %s: buffer is %zu bytes, too little for answers; at least %zu, better 65536",
                         door->name(), buffer_, smallest_buffer);
  }
  exposed_ = !remote::is_within_the_machine(address);
  if (!exposed_) return {};
  if (!configuration.other_machines) {
    return Status::error(
        StatusCode::not_permitted,
        "device %s listens at %.120s, which other machines reach; listen at tcp:127.0.0.1:..., "
        "or set other_machines = true and a token_file",
        door->name(), address.c_str());
  }
  if (!token_.is_there()) {
    return Status::error(
        StatusCode::not_permitted,
        "device %s listens at %.120s, which other machines reach, and there is no token; set "
        "token_file",
        door->name(), address.c_str());
  }
  return {};
}

// ---- a step

void RemoteControl::step(const Tick& tick) {
  now_ = tick.now;
  view_->begin_turn();
  meet_clients();
  take_answers();
  take_saves();
  for (Client& client : clients_) {
    send_unread(client);
    serve(client);
    send_updates(client);
  }
  count();
}

void RemoteControl::meet_clients() {
  const std::span<const SocketSession> sessions = door->sessions();
  std::erase_if(clients_, [&](const Client& client) {
    return std::find(sessions.begin(), sessions.end(), client.session) == sessions.end();
  });
  for (const SocketSession session : sessions) {
    if (find(session) != nullptr) continue;
    Client& client = clients_.emplace_back();
    client.session = session;
    client.since = now_;
  }
  const Duration patience = duration_of(configuration.token_timeout);
  for (Client& client : clients_) {
    if (exposed_ && !client.authenticated && !client.leaving && now_ - client.since > patience)
      send_away(client, "gave no token in time");
  }
}

std::string RemoteControl::who(const Client& client) {
  return "remote control (connection " + std::to_string(client.session) + ")";
}

RemoteControl::Client* RemoteControl::find(SocketSession session) noexcept {
  const auto found = std::find_if(clients_.begin(), clients_.end(),
                                  [&](const Client& client) { return client.session == session; });
  return found == clients_.end() ? nullptr : &*found;
}

/// Who does not read its answers is not heard either: what it says waits with it.
void RemoteControl::serve(Client& client) {
  for (std::size_t n = 0; n < lines_per_step && !client.leaving && client.unread.empty(); ++n) {
    const std::optional<std::string_view> line = door->read_line(client.session);
    if (!line) return;
    if (line->find_first_not_of(" \t") != std::string_view::npos) handle(client, *line);
  }
}

void RemoteControl::handle(Client& client, std::string_view line) {
  ++feedback.requests;
  remote::RpcCall call;
  Problem problem = reader_.read(line, call);
  if (!problem) problem = perform(client, call);
  if (problem) say_error(client, call.id, *problem);
  if (problem && problem->error == RpcError::token_missing && call.method == "authenticate")
    send_away(client, "gave a wrong token");
}

void RemoteControl::count() {
  feedback.clients = static_cast<std::uint8_t>(clients_.size());
  feedback.authenticated = static_cast<std::uint8_t>(std::count_if(
      clients_.begin(), clients_.end(), [](const Client& client) { return client.authenticated; }));
}

// ---- answers to requests

void RemoteControl::take_answers() {
  ParameterAnswer given;
  while (cell.take_answer(given)) {
    const auto found = std::find_if(waiting_.begin(), waiting_.end(),
                                    [&](const Waiting& one) { return one.correlation == given.correlation; });
    if (found == waiting_.end()) continue;  // overdue, or asked before a restart
    const Waiting waiting = std::move(*found);
    waiting_.erase(found);
    answer(waiting, given);
  }
  std::erase_if(waiting_, [this](const Waiting& waiting) {
    if (now_ < waiting.overdue_at) return false;
    if (Client* const client = find(waiting.session); client != nullptr) {
      const Refusal refusal = no_answer(view_->entry(waiting.component), answer_timeout);
      say_error(*client, waiting.id, remote::problem_of(refusal));
    }
    return true;
  });
}

void RemoteControl::take_saves() {
  if (saves_.empty()) return;
  const SaveState state = cell.save_state();
  std::erase_if(saves_, [&](const Save& save) {
    const bool is_done = state.answered >= save.number;
    if (!is_done && now_ < save.overdue_at) return false;
    Client* const client = find(save.session);
    if (client == nullptr) return true;
    if (!is_done) {
      say_error(*client, save.id, remote::problem_of(no_answer_of_disk(saving_timeout)));
    } else if (!state.failure) {
      say_error(*client, save.id, remote::problem_of(not_saved(RefusalKind::not_stored, state.failure)));
    } else {
      reply(*client, save.id, [&](JsonWriter& json) {
        json.begin_object().member("saved_at_ms", state.saved_at).end_object();
      });
    }
    return true;
  });
}

void RemoteControl::answer(const Waiting& waiting, const ParameterAnswer& given) {
  Client* const client = find(waiting.session);
  if (client == nullptr) return;
  if (given.kind != AnswerKind::accepted) {
    const Refusal refusal = refusal_of(given, view_->entry(waiting.component));
    return say_error(*client, waiting.id, remote::problem_of(refusal));
  }
  reply(*client, waiting.id, [&](JsonWriter& json) {
    // What was published before this answer came is what the answer speaks of.
    view_->begin_turn();
    if (waiting.wants_values) return view_->write_runtime(json, waiting.component);
    json.begin_object().end_object();
  });
}

// ---- what is said

void RemoteControl::say(Client& client, std::string_view id, std::string line) {
  if (line.size() + 1 > buffer_) {
    return say_error(client, id,
                     {RpcError::too_large, "the answer has " + std::to_string(line.size()) + " bytes",
                      "the buffer of the socket's device takes " + std::to_string(buffer_)});
  }
  if (client.unread.empty() && door->write_line(client.session, line)) return;
  if (client.unread.empty()) client.stuck_since = now_;
  client.unread.push_back(std::move(line));
}

void RemoteControl::say_error(Client& client, std::string_view id, const RpcProblem& problem) {
  ++feedback.refusals;
  if (!id.empty()) say(client, id, remote::error_line(id, problem));
}

void RemoteControl::send_unread(Client& client) {
  while (!client.unread.empty() && door->write_line(client.session, client.unread.front())) {
    client.unread.pop_front();
    client.stuck_since = now_;
  }
  if (!client.unread.empty() && !client.leaving && now_ - client.stuck_since > reading_timeout)
    send_away(client, "does not read its answers");
}

void RemoteControl::send_away(Client& client, const char* why) {
  client.leaving = true;
  client.authenticated = false;
  client.subscriptions.clear();
  door->close(client.session);
  ++feedback.sent_away;
  log_warning(sent_away_, name(), "connection {} was ended: who called {}", client.session, why);
}

/// The newest value wins: what there was no room for is not sent later.
void RemoteControl::send_updates(Client& client) {
  if (!client.unread.empty()) return;
  for (Subscription& wanted : client.subscriptions) {
    if (now_ < wanted.next) continue;
    wanted.next = std::max(wanted.next + wanted.interval, now_);
    const ObservedSlot& seen = view_->look(wanted.slot);
    if (wanted.any && seen.header.sequence == wanted.sequence && seen.reason == wanted.reason) continue;
    JsonWriter json(std::string{}, JsonWriter::Style::compact);
    json.begin_object().member("jsonrpc", "2.0").member("method", "slot").key("params").begin_object();
    view_->write_slot(json, wanted.slot, seen);
    json.member("dropped", client.dropped).end_object().end_object();
    if (door->write_line(client.session, json.release())) {
      wanted.any = true;
      wanted.sequence = seen.header.sequence;
      wanted.reason = seen.reason;
      ++feedback.updates;
    } else {
      ++client.dropped;
      ++feedback.dropped;
    }
  }
}

}  // namespace flexrf::user
