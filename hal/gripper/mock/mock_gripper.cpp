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
  activating_ = false;
  last_cycle_ = Time{};
  noise_.seed(environment().seed);
  delay_.clear();
  begin(configuration);
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

void MockGripper::hear(const Tick& tick) noexcept {
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
}

void MockGripper::move(Duration elapsed) noexcept {
  spent_ += elapsed;
  if (activating_) {
    if (seconds(spent_) < configuration.activation) return;
    activating_ = false;
    known_.activated = true;
    return stand_still(GripperObject::unknown);
  }
  if (!goal_) return;
  const FingerModel::Outcome outcome =
      fingers_.move(goal_->opening, goal_->speed.value_or(configuration.speed), elapsed);
  switch (outcome) {
    case FingerModel::Outcome::arrived:
      // Without a new command, what was between the fingers is gone.
      return stand_still(known_.holds_object() || known_.object == GripperObject::lost ? GripperObject::lost
                                                                                       : GripperObject::none);
    case FingerModel::Outcome::stopped_closing:
      return stand_still(GripperObject::gripped);
    case FingerModel::Outcome::stopped_opening:
      return stand_still(GripperObject::gripped_inside);
    case FingerModel::Outcome::moves:
      break;
  }
  if (!known_.moving || seconds(spent_) < configuration.travel_timeout) return;
  trouble_ = Status::error(StatusCode::timeout, "the mock's fingers did not come to rest within %g s",
                           configuration.travel_timeout);
  goal_.reset();
  stand_still(GripperObject::unknown);
}

void MockGripper::stand_still(GripperObject object) noexcept {
  known_.moving = false;
  known_.object = object;
}

void MockGripper::go(const GripperGoal& goal) noexcept {
  if (!is_ready()) return;
  goal_ = goal;
  if (configuration.object_width > 0 && goal.opening < fingers_.opening() && !known_.holds_object())
    fingers_.put_object(configuration.object_width);
  spent_ = {};
  known_.moving = true;
  known_.object = GripperObject::unknown;
  trouble_ = {};
  if (state_) state_ = known_;
}

void MockGripper::begin_activation() noexcept {
  if (!is_heard() || activating_ || (known_.activated && trouble_.is_ok())) return;
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

void MockGripper::halt() noexcept {
  if (activating_) {
    activating_ = false;
    stand_still(GripperObject::unknown);
  } else if (known_.moving && !configuration.two_state) {
    goal_.reset();
    stand_still(GripperObject::unknown);
  }
  if (state_) state_ = known_;
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
  stand_still(GripperObject::unknown);
}

}  // namespace flexrf
