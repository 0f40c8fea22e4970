#include "hal/gripper/interface/gripper.hpp"

namespace flexrf {

void Gripper::command(const GripperGoal& goal) noexcept {
  if (!may_act()) return;
  const GripperCapabilities can = capabilities();
  if (const Status status = check_goal(goal, can); !status) return fail(status);
  restrain(restraint_of(goal, can));
  was_led_ = true;
  go({within_reach(goal.opening, can), goal.speed, goal.force});
}

void Gripper::take_in(const Tick& tick) noexcept {
  hear(tick);
  report_.fill(name(), feedback, state(), trouble(), tick.now);
}

bool Gripper::become_safe() noexcept {
  if (safe_state_ == GripperSafeState::hold || !(releasing_ || is_ready())) {
    halt();
  } else if (!releasing_) {
    go({.opening = capabilities().open_width});
    releasing_ = was_led_ = true;
  }
  const auto heard = state();
  return heard ? !heard->moving && is_at_rest() : !was_led_;
}

}  // namespace flexrf
