#include "web-ui/server/api/edit_operations.hpp"

#include <algorithm>
#include <string>

namespace flexrf::panel {
namespace {

/// As the protocol writes it.
const char* word_of(ReconfigureOutcome outcome) noexcept {
  return outcome == ReconfigureOutcome::rolled_back ? "rolled_back" : name_of(outcome);
}

}  // namespace

// ---- what an edit asks for

bool EditOperations::is_at_rest(const Caller& caller) {
  if (executive_->control().mode() != Mode::running) {
    answers_->refuse(caller, RefusalKind::wrong_state,
                     "The application is %s; its configuration can be changed while it runs.",
                     phrase_of(executive_->control().mode()));
    return false;
  }
  const std::vector<ComponentIndex> moving = executive_->moving();
  if (moving.empty()) return true;
  Refusal refusal = Refusal::make(RefusalKind::moving,
                                  "%s%s may move; give Stop motion, and wait until everything is at rest.",
                                  directory_->entry(moving[0]).name, moving.size() > 1 ? " and others" : "");
  for (const ComponentIndex component : moving) refusal.moving(directory_->entry(component).name);
  answers_->refuse(caller, refusal);
  return false;
}

void EditOperations::count_anew(Time now) noexcept {
  ends_at_ = now + timeout_;
}

bool EditOperations::is_mine(const Caller& caller, std::string_view edit) {
  if (is_open() && edit == std::to_string(number_) && caller.session == owner_) return true;
  answers_->refuse(caller, RefusalKind::wrong_state,
                   "This edit is over (it was left open too long, or control was lost); begin anew.");
  return false;
}

// ---- operations

void EditOperations::begin(const Caller& caller, JsonArray components, Time now) {
  if (!permission_->may_control(caller, Role::engineer, "edit the configuration")) return;
  if (applying_ || (is_open() && caller.session != owner_)) {
    return answers_->refuse(
        caller, RefusalKind::wrong_state,
        "The configuration is being edited already; wait until that is applied or discarded.");
  }
  std::vector<ComponentIndex> wanted;
  for (const JsonElement element : components) {
    std::string_view name;
    if (element.get(name) != simdjson::SUCCESS)
      return answers_->refuse(caller, RefusalKind::bad_request, "'components' is a list of names.");
    const auto component = directory_->component(name);
    if (!component) return answers_->refuse(caller, directory_->no_component(name));
    if (std::find(wanted.begin(), wanted.end(), *component) == wanted.end()) wanted.push_back(*component);
  }
  if (wanted.empty()) {
    return answers_->refuse(caller, RefusalKind::bad_request,
                            "'components' is empty; name what is to be edited.");
  }
  if (!is_at_rest(caller)) return;
  number_ = ++last_number_;
  owner_ = caller.session;
  components_ = std::move(wanted);
  count_anew(now);
  ++revision_;
  answers_->done(caller, [this](JsonWriter& json) {
    json.member("edit", std::to_string(number_)).key("reinitialised").begin_array();
    for (const ComponentIndex owner : executive_->owners_of(components_))
      json.value(directory_->entry(owner).name);
    json.end_array().key("configuration").begin_object();
    for (const ComponentIndex component : components_) {
      json.key(directory_->entry(component).name);
      values_->write_configuration(json, component);
    }
    json.end_object();
  });
}

void EditOperations::apply(const Caller& caller, std::string_view edit, JsonArray changes, Time now) {
  if (!permission_->may_control(caller, Role::engineer, "apply an edit") || !is_mine(caller, edit)) return;
  if (applying_) {
    return answers_->refuse(caller, RefusalKind::busy, "It is being applied; its outcome comes by itself.");
  }
  WantedChanges wanted = read_changes(*directory_, changes);
  for (const ComponentIndex component : wanted.components) {
    if (std::find(components_.begin(), components_.end(), component) != components_.end()) continue;
    wanted.causes.push_back(std::string{directory_->entry(component).name} +
                            " is not part of this edit; discard it and begin one with this component");
  }
  if (!permission_->has_role(caller, wanted.role, "change these parameters") || !is_at_rest(caller)) return;
  count_anew(now);
  run(caller, wanted);
}

void EditOperations::discard(const Caller& caller, std::string_view edit) {
  if (!is_mine(caller, edit)) return;
  if (applying_) {
    return answers_->refuse(caller, RefusalKind::wrong_state,
                            "It is being applied and can no longer be discarded.");
  }
  end();
  answers_->done(caller);
}

void EditOperations::reconfigure(const Caller& caller, JsonArray changes, Time now) {
  if (!permission_->may_control(caller, Role::engineer, "change the configuration")) return;
  if (is_open()) {
    return answers_->refuse(caller, RefusalKind::wrong_state,
                            "The configuration is being edited; wait until that is over.");
  }
  const WantedChanges wanted = read_changes(*directory_, changes);
  if (!permission_->has_role(caller, wanted.role, "change these parameters") || !is_at_rest(caller)) return;
  number_ = ++last_number_;
  owner_ = caller.session;
  components_ = wanted.components;
  count_anew(now);
  ++revision_;
  run(caller, wanted);
  // What was refused at once is over; there is nobody who would correct it in this edit.
  if (!applying_) end();
}

// ---- the lifecycle thread's part

void EditOperations::run(const Caller& caller, const WantedChanges& wanted) {
  if (!wanted.causes.empty()) return answer(caller, {ReconfigureOutcome::refused, wanted.causes, {}});
  applying_ = true;
  applier_ = caller;
  executive_->reconfigure(
      wanted.changes, [results = results_](const ReconfigureResult& result) { results->push(result); },
      permission_->who(caller));
}

void EditOperations::answer(const Caller& caller, const ReconfigureResult& result) {
  answers_->done(caller, [this, &result](JsonWriter& json) {
    json.member("outcome", word_of(result.outcome)).key("causes").begin_array();
    for (const std::string& cause : result.causes) json.value(cause);
    json.end_array().key("owners").begin_array();
    for (const ComponentIndex owner : result.owners) json.value(directory_->entry(owner).name);
    json.end_array();
  });
}

void EditOperations::tick(Time now) {
  if (!is_open()) return;
  if (!applying_) {
    if (now >= ends_at_) end();
    return;
  }
  const auto result = results_->pop();
  if (!result) return;
  applying_ = false;
  answer(applier_, *result);
  // Who was refused, or rolled back, may correct it; by REST the request is over in any case.
  const bool is_over =
      result->outcome == ReconfigureOutcome::done || result->outcome == ReconfigureOutcome::fault;
  if (is_over || applier_.kind == Caller::Kind::rest || owner_ == no_session) {
    end();
  } else {
    count_anew(now);
  }
}

void EditOperations::on_control_lost(SessionIndex session) {
  if (!is_open() || owner_ != session) return;
  owner_ = no_session;
  if (!applying_) end();
}

void EditOperations::end() noexcept {
  number_ = 0;
  owner_ = no_session;
  components_.clear();
  ++revision_;
}

}  // namespace flexrf::panel
