#include "hal/gripper/mock/mock_gripper.hpp"

namespace flexrf {

Status MockGripper::initialise() {
  if (const Status status = check_widths(configuration.closed_width, configuration.open_width); !status)
    return status;
  fingers_ = FingerModel{configuration.closed_width, configuration.open_width};
  fault_ = Fault::none;
  known_ = {};
  known_.activated = configuration.activation <= 0;
  state_.reset();
  trouble_ = {};
  goal_.reset();
  activating_ = releasing_ = false;
  last_cycle_ = Time{};
  noise_.seed(environment().seed);
  delay_.clear();
  report_.reset();
  return {};
}

GripperCapabilities MockGripper::capabilities() const noexcept {
  const bool all = !configuration.two_state;
  return {.open_width = configuration.open_width,
          .closed_width = configuration.closed_width,
          .positions = all,
          .measures_opening = all,
          .speed = all,
          .force = all,
          .detects_object = true,
          .halts = all};
}

void MockGripper::receive(const Tick& tick) noexcept {
  const Duration elapsed = last_cycle_ == Time{} ? Duration{} : tick.now - last_cycle_;
  last_cycle_ = tick.now;
  if (fault_ != Fault::off) move(elapsed);
  const double opening = fingers_.opening();
  const bool at_end = opening == configuration.open_width || opening == configuration.closed_width;
  const double measured = delay_.pass(opening + noise_.around_zero(configuration.opening_noise), tick.now);
  known_.opening.reset();
  if (configuration.two_state && at_end) known_.opening = opening;
  if (!configuration.two_state) known_.opening = measured;
  state_.reset();
  if (is_heard()) state_ = known_;
  report_.fill(name(), feedback, state_, trouble_);
}

void MockGripper::move(Duration elapsed) noexcept {
  spent_ += elapsed;
  if (activating_) {
    if (seconds(spent_) < configuration.activation) return;
    activating_ = false;
    known_.activated = true;
    return rest(GripperObject::unknown);
  }
  if (!goal_) return;
  const FingerModel::Outcome outcome =
      fingers_.move(goal_->opening, goal_->speed.value_or(configuration.speed), elapsed);
  switch (outcome) {
    case FingerModel::Outcome::arrived:
      // Without a new command, what was between the fingers is gone.
      return rest(known_.holds_object() || known_.object == GripperObject::lost ? GripperObject::lost
                                                                                : GripperObject::none);
    case FingerModel::Outcome::stopped_closing:
      return rest(GripperObject::gripped);
    case FingerModel::Outcome::stopped_opening:
      return rest(GripperObject::gripped_inside);
    case FingerModel::Outcome::moves:
      break;
  }
  if (!known_.moving || seconds(spent_) < configuration.travel_timeout) return;
  trouble_ = Status::error(StatusCode::timeout, "the mock's fingers did not come to rest within %g s",
                           configuration.travel_timeout);
  goal_.reset();
  rest(GripperObject::unknown);
}

void MockGripper::rest(GripperObject object) noexcept {
  known_.moving = false;
  known_.object = object;
}

void MockGripper::go(const GripperGoal& goal) noexcept {
  goal_ = goal;
  goal_->opening = within_reach(goal.opening, capabilities());
  if (configuration.object_width > 0 && goal_->opening < fingers_.opening() && !known_.holds_object())
    fingers_.put_object(configuration.object_width);
  spent_ = {};
  known_.moving = true;
  known_.object = GripperObject::unknown;
  trouble_ = {};
  if (state_) state_ = known_;
}

void MockGripper::activate() noexcept {
  if (is_inhibited() || !is_heard() || activating_ || (known_.activated && trouble_.is_ok())) return;
  if (fault_ == Fault::tripped) fault_ = Fault::none;
  trouble_ = {};
  goal_.reset();
  spent_ = {};
  activating_ = true;
  known_.activated = false;
  known_.moving = true;
  known_.object = GripperObject::unknown;
  if (state_) state_ = known_;
}

void MockGripper::command(const GripperGoal& goal) noexcept {
  if (is_inhibited()) return;
  if (const Status status = check_goal(goal, capabilities()); !status) return fail(status);
  restrain(restraint_of(goal, capabilities()));
  if (is_heard() && known_.activated) go(goal);
}

void MockGripper::halt() noexcept {
  if (activating_) {
    activating_ = false;
    rest(GripperObject::unknown);
  } else if (known_.moving && !configuration.two_state) {
    goal_.reset();
    rest(GripperObject::unknown);
  }
  if (state_) state_ = known_;
}

void MockGripper::send(const Tick& /*tick*/) noexcept {
  if (!is_inhibited() && fault().is_ok()) {
    releasing_ = false;
  } else if (!releasing_) {
    halt();
  }
}

bool MockGripper::make_safe() noexcept {
  if (configuration.safe_state == GripperSafeState::hold || !known_.activated) {
    halt();
    return !known_.moving;
  }
  if (!releasing_) go({.opening = configuration.open_width});
  releasing_ = true;
  return !known_.moving;
}

void MockGripper::set_fault(Fault which) noexcept {
  fault_ = which;
  fingers_.set_stuck(which == Fault::stuck);
  switch (which) {
    case Fault::none:
      if (trouble_.code() == StatusCode::unavailable) trouble_ = {};
      break;
    case Fault::stuck:
      break;
    case Fault::tripped:
      trouble_ = Status::error(StatusCode::device_fault, "the mock's gripper tripped; activate it");
      break;
    case Fault::off:
      trouble_ = Status::error(StatusCode::unavailable, "the mock's gripper has no power");
      break;
    case Fault::silent:
      trouble_ = Status::error(StatusCode::unavailable, "the mock's gripper is not heard");
      break;
  }
  if (which == Fault::none || which == Fault::stuck) return;
  if (which != Fault::silent) known_.activated = false;
  goal_.reset();
  activating_ = false;
  rest(GripperObject::unknown);
}

}  // namespace flexrf
