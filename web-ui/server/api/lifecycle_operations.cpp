#include "web-ui/server/api/lifecycle_operations.hpp"

#include <algorithm>

namespace flexrf::panel {

void LifecycleOperations::act(const Caller& caller, ComponentIndex component, ComponentAction action) {
  if (!permission_->may_control(caller, Role::engineer, "start, stop or initialise a component")) return;
  const auto place =
      std::find_if(waiting_.begin(), waiting_.end(), [](const Waiting& waiting) { return !waiting.used; });
  if (place == waiting_.end()) {
    return answers_->refuse(
        caller,
        Refusal::make(RefusalKind::busy, "%zu actions are under way; wait until one is done.", most_waiting));
  }
  *place = {true, caller, component};
  ++waiting_count_;
  const auto index = static_cast<std::size_t>(place - waiting_.begin());
  executive_->act(
      action, component,
      [outcomes = outcomes_, index](const Status& status) {
        outcomes->push({index, status});
      },
      permission_->who(caller));
}

void LifecycleOperations::tick() {
  while (waiting_count_ != 0) {
    const auto outcome = outcomes_->pop();
    if (!outcome) return;
    Waiting& waiting = waiting_[outcome->place];
    waiting.used = false;
    --waiting_count_;
    if (outcome->status) {
      answers_->done(waiting.caller);
    } else {
      answers_->refuse(waiting.caller,
                       Refusal::make(RefusalKind::wrong_state, "%s: %s.",
                                     directory_->entry(waiting.component).name, outcome->status.cause())
                           .because(outcome->status.cause()));
    }
  }
}

}  // namespace flexrf::panel
