// What scripts may call.
#include <algorithm>

#include "base/nearest_name.hpp"
#include "units/remote_control/remote_change.hpp"
#include "units/remote_control/remote_control.hpp"

namespace flexrf::user {

using remote::RpcCall;
using remote::RpcError;
using remote::RpcProblem;

const RemoteControl::Method RemoteControl::methods[] = {
    {"authenticate", Need::nothing, &RemoteControl::authenticate},
    {"list", Need::to_look, &RemoteControl::list},
    {"read", Need::to_look, &RemoteControl::read},
    {"state", Need::to_look, &RemoteControl::state},
    {"subscribe", Need::to_look, &RemoteControl::subscribe},
    {"unsubscribe", Need::to_look, &RemoteControl::unsubscribe},
    {"stop_motion", Need::to_look, &RemoteControl::stop_motion},
    {"set", Need::to_change, &RemoteControl::set},
    {"press", Need::to_change, &RemoteControl::press},
    {"save_values", Need::to_change, &RemoteControl::save_values},
};

RemoteControl::Problem RemoteControl::perform(Client& client, const RpcCall& call) {
  NearestName nearest(call.method);
  for (const Method& method : methods) {
    nearest.offer(method.name);
    if (call.method != method.name) continue;
    if (auto problem = may(client, method.need)) return problem;
    Fields params(call.params);
    return (this->*method.perform)(client, call, params);
  }
  return RpcProblem{RpcError::method_not_found,
                    "there is no method '" + std::string{remote::shown(call.method)} + "'",
                    remote::nearest_hint(nearest.best(),
                                         "there are authenticate, list, read, state, subscribe, unsubscribe, "
                                         "stop_motion, set, press, save_values")};
}

/// Who may not change anything is told so first, and learns no more.
RemoteControl::Problem RemoteControl::may(const Client& client, Need need) const {
  if (need == Need::nothing || client.authenticated) {
    if (need != Need::to_change || runtime.remote) return std::nullopt;
    return RpcProblem{RpcError::not_remote, "scripts may look, but not change anything now",
                      "the person at the panel sets " + std::string{name()} + ".remote"};
  }
  if (need == Need::to_look && !exposed_) return std::nullopt;
  if (!token_.is_there()) {
    return RpcProblem{RpcError::token_missing, "there is no token, so nobody may change anything",
                      "set token_file of " + std::string{name()}};
  }
  return RpcProblem{RpcError::token_missing, "this connection has not given the token",
                    R"(first: {"method": "authenticate", "params": {"token": "..."}})"};
}

RemoteControl::Problem RemoteControl::authenticate(Client& client, const RpcCall& call, Fields& params) {
  const std::string_view token = params.text("token");
  if (!params.status()) return remote::wrong_params(params, R"(write {"token": "..."})");
  if (!token_.is(token)) {
    ++feedback.wrong_tokens;
    cell.note(who(client), "gave a wrong token");
    return RpcProblem{RpcError::token_missing,
                      token_.is_there() ? "this is not the token" : "there is no token to be given",
                      "the connection ends here; token_file of " + std::string{name()} + " has it"};
  }
  client.authenticated = true;
  cell.note(who(client), "gave the token");
  reply(client, call.id,
        [](JsonWriter& json) { json.begin_object().member("role", "operator").end_object(); });
  return std::nullopt;
}

RemoteControl::Problem RemoteControl::list(Client& client, const RpcCall& call, Fields& params) {
  Problem problem;
  const std::string line = remote::result_line(call.id.empty() ? "null" : call.id, [&](JsonWriter& json) {
    problem = view_->list(params, json, buffer_);
  });
  if (!problem && !call.id.empty()) say(client, call.id, line);
  return problem;
}

RemoteControl::Problem RemoteControl::read(Client& client, const RpcCall& call, Fields& params) {
  Problem problem;
  const std::string line = remote::result_line(
      call.id.empty() ? "null" : call.id, [&](JsonWriter& json) { problem = view_->read(params, json); });
  if (!problem && !call.id.empty()) say(client, call.id, line);
  return problem;
}

RemoteControl::Problem RemoteControl::state(Client& client, const RpcCall& call, Fields& /*params*/) {
  reply(client, call.id, [this](JsonWriter& json) {
    const Control& control = cell.cell().control();
    json.begin_object().member("application", cell.cell().application().name);
    json.member("mode", name_of(control.mode())).key("motion").begin_object();
    json.member("stopped", control.motion_stopped()).member("may_move", control.may_move()).end_object();
    json.member("remote", runtime.remote);
    const SaveState values = cell.save_state();
    json.key("values").begin_object().member("file", values.has_file).member("unsaved", values.unsaved);
    json.member("failure", values.failure.cause()).end_object().end_object();
  });
  return std::nullopt;
}

RemoteControl::Problem RemoteControl::stop_motion(Client& client, const RpcCall& call, Fields& /*params*/) {
  cell.stop_motion(who(client));
  reply(client, call.id, [](JsonWriter& json) { json.begin_object().end_object(); });
  return std::nullopt;
}

// ---- changing

RemoteControl::Problem RemoteControl::set(Client& client, const RpcCall& call, Fields& params) {
  return change(client, call, params, false);
}

RemoteControl::Problem RemoteControl::press(Client& client, const RpcCall& call, Fields& params) {
  return change(client, call, params, true);
}

RemoteControl::Problem RemoteControl::change(Client& client, const RpcCall& call, Fields& params,
                                             bool is_press) {
  const std::string_view name_given = params.text("component");
  if (!params.status()) {
    return remote::wrong_params(params, "name a unit or a device in 'component'");
  }
  ComponentIndex index = 0;
  if (auto problem = view_->find(Part::component, name_given, index)) return problem;
  if (index == cell.self()) {
    return RpcProblem{RpcError::role_missing, "what scripts may do is not for scripts to say",
                      "a person changes it in the panel"};
  }
  const ComponentEntry& component = view_->entry(index);
  ParameterRequest request;
  if (auto problem = is_press ? remote::read_press(params, component, request)
                              : remote::read_set(params, component, request))
    return problem;
  const auto mine = std::count_if(waiting_.begin(), waiting_.end(),
                                  [&](const Waiting& waiting) { return waiting.session == client.session; });
  if (static_cast<std::size_t>(mine) >= most_waiting) {
    return RpcProblem{RpcError::busy, "8 requests of this connection wait for an answer",
                      "try again when one is answered"};
  }
  request.component = index;
  request.set_who(who(client));
  const std::uint64_t correlation = cell.send(request, now_);
  waiting_.push_back({client.session, call.id, index, !is_press, correlation, now_ + answer_timeout});
  return std::nullopt;
}

/// The runtime writes in a thread of its own; take_saves() answers.
RemoteControl::Problem RemoteControl::save_values(Client& client, const RpcCall& call, Fields& /*params*/) {
  if (saves_.size() >= most_waiting) return remote::problem_of(saving_already());
  const Result<std::uint64_t> number = cell.save_values();
  if (!number) return remote::problem_of(not_saved(RefusalKind::wrong_state, number.status()));
  saves_.push_back({client.session, call.id, *number, now_ + saving_timeout});
  return std::nullopt;
}

// ---- subscriptions

RemoteControl::Problem RemoteControl::read_subscription(JsonElement json, Subscription& subscription) const {
  std::string_view slot_name;
  double rate = SlotRate::usual;
  if (JsonObject object; json.get(object) == simdjson::SUCCESS) {
    Fields fields(object);
    slot_name = fields.text("name");
    rate = fields.number_or("rate", SlotRate::usual);
    if (!fields.status()) return remote::wrong_params(fields, R"(write {"name": NAME, "rate": 10})");
  } else if (json.get(slot_name) != simdjson::SUCCESS) {
    return RpcProblem{RpcError::invalid_params, "'slots' holds something that names no slot",
                      R"(write [{"name": NAME, "rate": 10}])"};
  }
  if (!SlotRate::is_possible(rate)) {
    return RpcProblem{RpcError::invalid_params, "'rate' does not lie within its bounds",
                      "from 0.01 to 60 values in a second"};
  }
  if (auto problem = view_->find(Part::slot, slot_name, subscription.slot)) return problem;
  if (view_->slot(subscription.slot).observer == nullptr) {
    return RpcProblem{RpcError::refused, "'" + std::string{slot_name} + "' is not observed",
                      "its table says observe = false"};
  }
  if (auto problem = view_->too_much(subscription.slot)) return problem;
  subscription.interval = duration_of(1.0 / rate);
  subscription.next = now_;
  return std::nullopt;
}

/// All or none, in place of what was subscribed before.
RemoteControl::Problem RemoteControl::subscribe(Client& client, const RpcCall& call, Fields& params) {
  const auto slots = params.array("slots");
  if (!params.status())
    return remote::wrong_params(params, R"(write {"slots": [{"name": NAME, "rate": 10}]})");
  if (slots->size() > most_subscriptions)
    return RpcProblem{RpcError::too_large, "more than 32 slots",
                      "subscribe to fewer, or from two connections"};
  std::vector<Subscription> wanted;
  for (const JsonElement json : *slots) {
    Subscription one;
    if (auto problem = read_subscription(json, one)) return problem;
    std::erase_if(wanted, [&](const Subscription& other) { return other.slot == one.slot; });
    wanted.push_back(one);
  }
  client.subscriptions = std::move(wanted);
  tell_subscriptions(client, call);
  return std::nullopt;
}

RemoteControl::Problem RemoteControl::unsubscribe(Client& client, const RpcCall& call, Fields& params) {
  if (!params.has("slots")) {
    client.subscriptions.clear();
    tell_subscriptions(client, call);
    return std::nullopt;
  }
  const auto slots = params.array("slots");
  if (!params.status())
    return remote::wrong_params(params, R"(write {"slots": [NAME]}, or nothing to end all)");
  std::vector<Subscription> rest = client.subscriptions;
  for (const JsonElement json : *slots) {
    std::string_view slot_name;
    std::uint16_t slot = 0;
    if (json.get(slot_name) != simdjson::SUCCESS) {
      return RpcProblem{RpcError::invalid_params, "'slots' holds something that names no slot",
                        R"(write {"slots": [NAME]})"};
    }
    if (auto problem = view_->find(Part::slot, slot_name, slot)) return problem;
    std::erase_if(rest, [&](const Subscription& one) { return one.slot == slot; });
  }
  client.subscriptions = std::move(rest);
  tell_subscriptions(client, call);
  return std::nullopt;
}

void RemoteControl::tell_subscriptions(Client& client, const RpcCall& call) {
  reply(client, call.id, [&](JsonWriter& json) {
    json.begin_object().key("slots").begin_array();
    for (const Subscription& one : client.subscriptions) json.value(view_->slot(one.slot).name);
    json.end_array().end_object();
  });
}

}  // namespace flexrf::user
