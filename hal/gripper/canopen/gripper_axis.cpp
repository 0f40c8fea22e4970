#include "hal/gripper/canopen/gripper_axis.hpp"

#include <algorithm>
#include <cmath>

#include "hal/gripper/interface/gripper_report.hpp"

namespace flexrf::canopen {
namespace {

// What the drive says of its velocity is some cycles old.
constexpr Duration rest_time = std::chrono::milliseconds(50);

Status check(const GripperAxisPlan& plan) noexcept {
  if (const Status status = check_widths(plan.closed_width, plan.open_width); !status) return status;
  if (plan.weakest < plan.strongest && plan.rated_force > 0) return {};
  return Status::error(StatusCode::invalid_argument,
                       "configuration: weakest is to be less than strongest, and rated_force above 0");
}

}  // namespace

Status GripperAxis::open(const GripperAxisPlan& plan, const cia402::AxisPlan& axis, CanBus& bus,
                         const char* name) {
  if (const Status status = check(plan); !status) return status;
  plan_ = plan;
  axis_plan_ = axis;
  axis_plan_.mode = cia402::Mode::profile_position;
  axis_plan_.lowest = plan.closed_width - plan.opening_at_zero;
  axis_plan_.highest = plan.open_width - plan.opening_at_zero;
  drop();
  state_.reset();
  trouble_ = {};
  return link_.open(axis_plan_, bus, name);
}

bool GripperAxis::activates() const noexcept {
  return phase_ == Phase::clearing || phase_ == Phase::enabling || phase_ == Phase::homing;
}

bool GripperAxis::is_active() const noexcept {
  const auto& axis = link_.axis();
  return has_power_ && !activates() && axis.state() && axis.fault().is_ok() && axis.is_enabled();
}

double GripperAxis::opening() const noexcept {
  return link_.axis().state()->position + plan_.opening_at_zero;
}

void GripperAxis::enter(Phase phase) noexcept {
  phase_ = phase;
  began_ = now_;
  still_since_.reset();
}

void GripperAxis::limit_force(double force) noexcept {
  const double kept = std::clamp(force, plan_.weakest, plan_.strongest);
  most_torque_ = axis_plan_.limits_torque ? kept / plan_.rated_force : 1;
  link_.axis().limit_torque(most_torque_);
}

/// It is not led any more; only activate() begins again.
void GripperAxis::drop() noexcept {
  enter(Phase::idle);
  has_power_ = false;
  object_ = GripperObject::unknown;
  latched_ = {};
}

void GripperAxis::receive(const Tick& tick) noexcept {
  now_ = tick.now;
  link_.receive(tick);
  const auto& axis = link_.axis();
  if (!axis.state() || (!axis.fault().is_ok() && phase_ != Phase::clearing)) {
    drop();
  } else {
    follow();
  }
  renew();
}

void GripperAxis::follow() noexcept {
  auto& axis = link_.axis();
  watch_rest(*axis.state());
  switch (phase_) {
    case Phase::clearing:
      // It was told to be off in the cycle before.
      axis.forget_fault();
      limit_force(plan_.force);  // also of its homing
      has_power_ = true;
      phase_ = Phase::enabling;
      break;
    case Phase::enabling:
      if (!axis.is_enabled()) break;
      if (axis.homing() != cia402::Homing::homed) axis.home();
      phase_ = Phase::homing;
      break;
    case Phase::homing:
      follow_homing();
      break;
    case Phase::going:
      follow_goal();
      break;
    case Phase::halting:
      if (has_power_ ? rests_for(rest_time) : axis.is_off()) enter(Phase::idle);
      break;
    case Phase::idle: {
      const bool held = object_ == GripperObject::gripped || object_ == GripperObject::gripped_inside;
      const bool went_on = axis.state()->target_reached || std::abs(opening() - gripped_at_) > plan_.slip;
      if (held && went_on) object_ = GripperObject::lost;
      break;
    }
  }
  check_time();
}

void GripperAxis::watch_rest(const cia402::AxisState& axis) noexcept {
  const bool rests = std::abs(axis.velocity) <= axis_plan_.rest_velocity;
  const bool presses = !axis_plan_.tells_torque || std::abs(axis.torque) >= plan_.grip_share * most_torque_;
  if (!rests || (phase_ == Phase::going && !presses)) {
    still_since_.reset();
  } else if (!still_since_) {
    still_since_ = now_;
  }
}

bool GripperAxis::rests_for(Duration time) const noexcept {
  return still_since_ && now_ - *still_since_ >= time;
}

bool GripperAxis::is_at_rest() const noexcept {
  return phase_ == Phase::idle && (has_power_ ? rests_for(rest_time) : link_.axis().is_off());
}

void GripperAxis::follow_homing() noexcept {
  const auto& axis = link_.axis();
  if (axis.homing() == cia402::Homing::homed) {
    enter(Phase::idle);
  } else if (axis.homing() != cia402::Homing::running) {
    has_power_ = false;
    enter(Phase::halting);
    latched_ = Status::error(StatusCode::device_fault,
                             "its fingers did not find their home: %s; clear their way, then activate it",
                             axis.homing_problem().cause());
  }
}

void GripperAxis::follow_goal() noexcept {
  if (link_.axis().state()->target_reached) {
    object_ = GripperObject::none;
    enter(Phase::idle);
  } else if (rests_for(plan_.grip_time)) {
    grip();
  }
}

void GripperAxis::grip() noexcept {
  object_ = closes_ ? GripperObject::gripped : GripperObject::gripped_inside;
  gripped_at_ = opening();
  enter(Phase::idle);
}

void GripperAxis::check_time() noexcept {
  if (phase_ == Phase::idle) return;
  const Duration limit = activates() ? plan_.activation_timeout : plan_.travel_timeout;
  if (now_ - began_ <= limit) return;
  if (activates()) {
    latched_ = Status::error(StatusCode::timeout,
                             "its drive was not %s within %g s; is its power stage on, and nothing in the "
                             "fingers' way?",
                             phase_ == Phase::homing ? "homed" : "enabled", seconds(limit));
    has_power_ = false;
    enter(Phase::halting);
  } else if (phase_ == Phase::going) {
    halt();
    latched_ = Status::error(
        StatusCode::timeout,
        "the fingers did not come to rest within %g s, neither arrived nor pressing on an object; is the "
        "motor's cable in, the fingers' way free, or the time too short for their speed?",
        seconds(limit));
  } else {
    // The drive is told to be off, and has been told to stop before.
    has_power_ = false;
    enter(Phase::idle);
    if (latched_.is_ok()) {
      latched_ = Status::error(StatusCode::timeout, "its drive does not come to rest; it was switched off");
    }
  }
}

void GripperAxis::activate() noexcept {
  if (activates()) return;
  if (link_.axis().node().state() == NodeState::refused) {
    link_.begin_again();
    return;
  }
  if (!link_.axis().state()) return;
  latched_ = {};
  if (!is_active()) {
    has_power_ = false;
    object_ = GripperObject::unknown;
    enter(Phase::clearing);
  }
  renew();
}

void GripperAxis::command(const GripperGoal& goal) noexcept {
  if (!is_active()) return;
  // Commanded in every cycle, it is one way with one time-out.
  if (phase_ == Phase::going && goal.opening == goal_.opening && goal.speed == goal_.speed &&
      goal.force == goal_.force)
    return;
  goal_ = goal;
  closes_ = goal.opening < opening();
  limit_force(goal.force.value_or(plan_.force));
  link_.axis().move_to(goal.opening - plan_.opening_at_zero, goal.speed.value_or(plan_.speed));
  enter(Phase::going);
  object_ = GripperObject::unknown;
  latched_ = {};
  renew();
}

void GripperAxis::halt() noexcept {
  switch (phase_) {
    case Phase::clearing:
    case Phase::enabling:
    case Phase::homing:
      has_power_ = false;
      enter(Phase::halting);
      break;
    case Phase::going:
      // What it presses on already would fall if it were stopped where it is.
      if (still_since_ && axis_plan_.tells_torque) {
        grip();
        break;
      }
      link_.axis().halt();
      enter(Phase::halting);
      break;
    case Phase::halting:
    case Phase::idle:
      return;
  }
  renew();
}

void GripperAxis::renew() noexcept {
  trouble_ = find_trouble();
  state_.reset();
  const auto& axis = link_.axis();
  if (!axis.state()) return;
  GripperState& state = state_.emplace();
  state.activated = is_active();
  state.moving = phase_ != Phase::idle;
  state.object = object_;
  if (axis.homing() == cia402::Homing::homed) state.opening = opening();
}

Status GripperAxis::find_trouble() const noexcept {
  const auto& axis = link_.axis();
  const Status& of_node = axis.node().problem();
  if (axis.node().state() == NodeState::refused) {
    return Status::error(StatusCode::device_fault, "%s; put it right, then activate it", of_node.cause());
  }
  if (!axis.state()) {
    const Status& why = of_node.is_ok() ? axis.fault() : of_node;
    return Status::error(StatusCode::unavailable, "the gripper's drive is not heard: %s",
                         why.is_ok() ? "it has not said yet where it is" : why.cause());
  }
  if (phase_ == Phase::clearing || axis.fault().is_ok()) return latched_;
  if (axis.fault().code() == StatusCode::unavailable) {
    return Status::error(StatusCode::device_fault, "its drive was gone, and is off: %s; activate it",
                         axis.fault().cause());
  }
  return Status::error(axis.fault().code(), "%s; see to the cause, then activate it", axis.fault().cause());
}

}  // namespace flexrf::canopen
