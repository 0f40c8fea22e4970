#include "hal/gripper/interface/finger_control.hpp"

namespace flexrf {

void FingerControl::begin(const Plan& plan) noexcept {
  *this = FingerControl();
  plan_ = plan;
  fingers_ = FingerModel{plan.closed_width, plan.open_width};
  known_.activated = plan.activation <= 0;
}

void FingerControl::advance(Duration elapsed) noexcept {
  if (fault_ == Fault::off) return;
  spent_ += elapsed;
  if (activating_) {
    if (seconds(spent_) < plan_.activation) return;
    activating_ = false;
    known_.activated = true;
    return stand_still(GripperObject::unknown);
  }
  if (!goal_) return;
  switch (fingers_.move(goal_->opening, goal_->speed.value_or(plan_.speed), elapsed)) {
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
  if (!known_.moving || seconds(spent_) < plan_.travel_timeout) return;
  trouble_ = Status::error(StatusCode::timeout, "%s fingers did not come to rest within %g s", plan_.whose,
                           plan_.travel_timeout);
  goal_.reset();
  stand_still(GripperObject::unknown);
}

void FingerControl::stand_still(GripperObject object) noexcept {
  known_.moving = false;
  known_.object = object;
}

void FingerControl::go(const GripperGoal& goal) noexcept {
  if (!is_ready()) return;
  goal_ = goal;
  spent_ = {};
  known_.moving = true;
  known_.object = GripperObject::unknown;
  trouble_ = {};
}

void FingerControl::activate() noexcept {
  if (!is_heard() || activating_ || (known_.activated && trouble_.is_ok())) return;
  if (fault_ == Fault::tripped) fault_ = Fault::none;
  trouble_ = {};
  goal_.reset();
  spent_ = {};
  activating_ = true;
  known_.activated = false;
  known_.moving = true;
  known_.object = GripperObject::unknown;
}

void FingerControl::halt() noexcept {
  if (activating_) {
    activating_ = false;
    stand_still(GripperObject::unknown);
  } else if (known_.moving && plan_.halts) {
    goal_.reset();
    stand_still(GripperObject::unknown);
  }
}

void FingerControl::set_fault(Fault which) noexcept {
  fault_ = which;
  fingers_.set_stuck(which == Fault::stuck);
  switch (which) {
    case Fault::none:
      if (trouble_.code() == StatusCode::unavailable) trouble_ = {};
      break;
    case Fault::stuck:
      break;
    case Fault::tripped:
      trouble_ = Status::error(StatusCode::device_fault, "%s gripper tripped; activate it", plan_.whose);
      break;
    case Fault::off:
      trouble_ = Status::error(StatusCode::unavailable, "%s gripper has no power", plan_.whose);
      break;
    case Fault::silent:
      trouble_ = Status::error(StatusCode::unavailable, "%s gripper is not heard", plan_.whose);
      break;
  }
  if (which == Fault::none || which == Fault::stuck) return;
  if (which != Fault::silent) known_.activated = false;
  goal_.reset();
  activating_ = false;
  stand_still(GripperObject::unknown);
}

}  // namespace flexrf
