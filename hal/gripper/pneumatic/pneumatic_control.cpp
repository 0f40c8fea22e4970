#include "hal/gripper/pneumatic/pneumatic_control.hpp"

namespace flexrf::pneumatic {
namespace {

const char* name_of(End end) {
  return end == End::open ? "open" : "closed";
}
End opposite(End end) {
  return end == End::open ? End::closed : End::open;
}

}  // namespace

void Control::begin(const ControlPlan& plan) noexcept {
  *this = Control{};
  plan_ = plan;
}

End Control::end() const noexcept {
  if (!reeds_ || reeds_->open == reeds_->closed) return End::none;
  return reeds_->open ? End::open : End::closed;
}

void Control::receive(const std::optional<Reeds>& reeds, Time now) noexcept {
  now_ = now;
  reeds_ = reeds;
  if (!reeds) {
    // Both valves are off, now or when the lines are ours again.
    phase_ = Phase::resting;
    wanted_ = on_ = arrived_ = target_ = End::none;
    object_ = GripperObject::unknown;
    latched_ = {};
  } else if (phase_ == Phase::going) {
    follow();
  } else {
    watch();
  }
  renew();
}

void Control::follow() noexcept {
  if (end() == target_) {
    phase_ = Phase::resting;
    arrived_ = target_;
    object_ = GripperObject::none;
  } else if (now_ - began_ > plan_.travel_timeout) {
    const bool between = !reeds_->open && !reeds_->closed;
    if (between && target_ == End::closed && plan_.object_between) {
      phase_ = Phase::resting;
      object_ = GripperObject::gripped;
    } else {
      give_up();
    }
  }
}

void Control::give_up() noexcept {
  phase_ = Phase::resting;
  object_ = GripperObject::unknown;
  // Nothing shall jump when the air returns: the valve is set to where the fingers are, if that is known.
  wanted_ = plan_.closed_centre ? End::none : end();
  const char* seen = contradict() ? "both reed switches are on: one is stuck, or wires are mixed up"
                     : end() == opposite(target_)
                         ? "they did not leave the other end: no air, a valve that does "
                           "not switch, or jammed"
                         : "they are between the ends: too little air, jammed, or a "
                           "broken reed switch or wire";
  latched_ = Status::error(StatusCode::timeout, "the fingers were not %s within %g s; %s", name_of(target_),
                           seconds(plan_.travel_timeout), seen);
}

/// Whether it stays where it came to rest.
void Control::watch() noexcept {
  const bool held = object_ == GripperObject::gripped;
  if (held && end() != End::none) object_ = GripperObject::lost;
}

void Control::go(End towards) noexcept {
  if (!follows() || (phase_ == Phase::going && towards == target_)) return;
  phase_ = Phase::going;
  target_ = towards;
  wanted_ = towards;
  arrived_ = End::none;
  began_ = now_;
  object_ = GripperObject::unknown;
  forgive();
}

void Control::halt() noexcept {
  if (phase_ != Phase::going || !plan_.closed_centre) return;
  phase_ = Phase::resting;
  wanted_ = End::none;
  renew();
}

void Control::forgive() noexcept {
  latched_ = {};
  renew();
}

End Control::valve() noexcept {
  if (on_ != wanted_ && on_ != End::none) {
    on_ = End::none;
    off_since_ = now_;
    if (plan_.dead_time > Duration{}) return on_;
  }
  if (on_ == End::none && (off_since_ == Time{} || now_ - off_since_ >= plan_.dead_time)) on_ = wanted_;
  return on_;
}

void Control::renew() noexcept {
  state_.reset();
  if (!reeds_) {
    trouble_ = Status::error(StatusCode::unavailable,
                             "the GPIO chip with its valves and reed switches is away; is it plugged in?");
    return;
  }
  GripperState& state = state_.emplace();
  state.activated = follows();
  state.moving = phase_ == Phase::going;
  state.object = object_;
  if (end() != End::none) state.opening = end() == End::open ? plan_.open_width : plan_.closed_width;
  if (contradict()) {
    trouble_ =
        Status::error(StatusCode::device_fault,
                      "both reed switches are on, and the fingers cannot be at both ends; one is stuck, "
                      "or wires are mixed up or shorted");
  } else if (!latched_.is_ok()) {
    trouble_ = latched_;
  } else if (arrived_ != End::none && end() != arrived_) {
    trouble_ =
        Status::error(StatusCode::device_fault,
                      "the fingers were %s, and no longer are without a command; is the air on, and the "
                      "reed switch and its wire sound?",
                      name_of(arrived_));
  } else {
    trouble_ = {};
  }
}

}  // namespace flexrf::pneumatic
