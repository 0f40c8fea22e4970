#include "web-ui/server/api/lifecycle_operations.hpp"

namespace flexrf::panel {

void LifecycleOperations::act(const Caller& caller, ComponentIndex component, ComponentAction action) {
  if (!permission_->may_control(caller, Role::engineer, "start, stop or initialise a component")) return;
  if (waiting_.is_full()) {
    return answers_->refuse(caller, RefusalKind::busy, "%zu actions are under way; wait until one is done.",
                            most_waiting);
  }
  const std::uint64_t number = ++last_number_;
  waiting_.add({caller, component, number});
  executive_->act(
      action, component,
      [outcomes = outcomes_, number](const Status& status) {
        outcomes->push({number, status});
      },
      permission_->who(caller));
}

void LifecycleOperations::tick() {
  while (!waiting_.is_empty()) {
    const auto outcome = outcomes_->pop();
    if (!outcome) return;
    waiting_.take([&](const Waiting& one) { return one.number == outcome->number; },
                  [&](const Waiting& waiting) { answer(waiting, outcome->status); });
  }
}

void LifecycleOperations::answer(const Waiting& waiting, const Status& status) {
  if (status) return answers_->done(waiting.caller);
  answers_->refuse(waiting.caller, Refusal::make(RefusalKind::wrong_state, "%s: %s.",
                                                 directory_->entry(waiting.component).name, status.cause())
                                       .because(status.cause()));
}

}  // namespace flexrf::panel
