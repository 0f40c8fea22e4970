#include "units/gantry/gantry.hpp"

#include <algorithm>
#include <cmath>

namespace flexrf::user {
namespace {

Status trouble_of(const ServoDrive& axis, const std::optional<ServoState>& state) {
  if (!axis.fault().is_ok())
    return Status::error(StatusCode::device_fault, "%s: %s", axis.name(), axis.fault().cause());
  if (!state) return Status::error(StatusCode::unavailable, "%s says nothing", axis.name());
  return {};
}

}  // namespace

Status Gantry::initialise() {
  phase_ = Phase::resting;
  taken_ = {};
  outcome_ = GantryOutcome::none;
  trouble_ = hindrance_ = {};
  last_cycle_ = Time{};
  followed_ = false;
  return {};
}

void Gantry::step(const Tick& tick) {
  const double elapsed = elapsed_in(tick);
  x_state_ = x->state();
  z_state_ = z->state();
  if (may_follow(tick)) {
    take_up_order(tick);
    path_.advance(elapsed);
    go_on(tick);
    command();
  }
  publish(tick);
}

/// Whether both drives follow. When they do not, what was ordered is given up, and the set-points stay where
/// the axes are; also where one that was not heard turns up.
bool Gantry::may_follow(const Tick& tick) noexcept {
  hindrance_ = trouble_of(*x, x_state_);
  if (hindrance_) hindrance_ = trouble_of(*z, z_state_);
  const bool follow = hindrance_ && !tick.motion_inhibited && x_state_->enabled && z_state_->enabled;
  if (follow && !followed_) seed_from_drives();
  followed_ = follow;
  if (follow) return true;
  const auto wanted = order.latest();
  const bool is_new = wanted && wanted->number != taken_.number;
  if (phase_ != Phase::resting || is_new) {
    // An order from before is not followed afterwards.
    if (is_new) taken_ = *wanted;
    end(GantryOutcome::failed, Status::error(StatusCode::not_permitted, "a drive does not follow"));
  }
  if (tick.motion_inhibited) trouble_ = {};  // that says it all
  seed_from_drives();
  return false;
}

void Gantry::take_up_order(const Tick& tick) noexcept {
  const auto wanted = order.latest();
  if (!wanted || tick.stop_requested) {
    if (phase_ == Phase::resting || phase_ == Phase::braking || phase_ == Phase::homing_ends) return;
    trouble_ = Status::error(StatusCode::unavailable, "%s",
                             tick.stop_requested ? "the application stops" : "nobody says what to do");
    brake();
    return;
  }
  if (wanted->number == taken_.number) return;
  if (phase_ != Phase::resting && phase_ != Phase::settling) {
    brake();  // and is taken up when the axes rest
    return;
  }
  taken_ = *wanted;
  begin(taken_);
}

void Gantry::begin(const GantryOrder& wanted) noexcept {
  outcome_ = GantryOutcome::busy;
  trouble_ = {};
  switch (wanted.command) {
    case GantryCommand::hold:
      end(GantryOutcome::done);
      return;
    case GantryCommand::home:
      phase_ = Phase::homing_first;
      z->home();
      z_state_ = z->state();  // homing runs from the call on
      return;
    case GantryCommand::move:
      break;
  }
  if (x_state_->homing != ServoHoming::homed || z_state_->homing != ServoHoming::homed) {
    end(GantryOutcome::failed,
        Status::error(StatusCode::not_permitted, "the axes do not know where they are; home them first"));
    return;
  }
  const auto limits_of = [this](std::size_t axis) {
    return MotionLimits{configuration.velocity[axis], configuration.acceleration[axis],
                        configuration.jerk[axis]};
  };
  if (!path_.plan(wanted.point, {limits_of(0), limits_of(1)}, wanted.speed)) {
    end(GantryOutcome::failed, Status::error(StatusCode::invalid_argument,
                                             "the order's point or speed is no number that makes sense"));
    return;
  }
  ++feedback.motions;
  phase_ = Phase::moving;
}

void Gantry::brake() noexcept {
  if (phase_ == Phase::homing_first || phase_ == Phase::homing_second) {
    x->halt();
    z->halt();
    phase_ = Phase::homing_ends;
  } else if (phase_ == Phase::moving || phase_ == Phase::settling) {
    path_.stop();
    phase_ = Phase::braking;
  }
}

void Gantry::go_on(const Tick& tick) noexcept {
  switch (phase_) {
    case Phase::resting:
      break;
    case Phase::moving:
      if (path_.is_moving()) break;
      phase_ = Phase::settling;
      settles_since_ = tick.now;
      settle(tick.now);
      break;
    case Phase::settling:
      settle(tick.now);
      break;
    case Phase::braking:
      if (!path_.is_moving()) end(GantryOutcome::failed, trouble_);
      break;
    case Phase::homing_first:
    case Phase::homing_second:
      home_on();
      break;
    case Phase::homing_ends:
      if (x_state_->homing == ServoHoming::running || z_state_->homing == ServoHoming::running) break;
      seed_from_drives();
      end(GantryOutcome::failed, trouble_);
      break;
  }
}

void Gantry::home_on() noexcept {
  ServoDrive& axis = phase_ == Phase::homing_first ? *z : *x;
  const ServoHoming homing = (phase_ == Phase::homing_first ? z_state_ : x_state_)->homing;
  if (homing == ServoHoming::running) return;
  if (homing == ServoHoming::homed) {
    // Where an axis is counts from its home now.
    seed_from_drives();
    if (phase_ == Phase::homing_second) return end(GantryOutcome::done);
    phase_ = Phase::homing_second;
    x->home();
    x_state_ = x->state();
    return;
  }
  end(GantryOutcome::failed,
      Status::error(StatusCode::device_fault, "%s did not find its home: %s", axis.name(),
                    homing == ServoHoming::failed ? axis.homing_problem().cause() : "it did not begin"));
}

void Gantry::settle(Time now) noexcept {
  const GantryPoint& target = path_.point();
  const double x_error = std::abs(x_state_->position - target[0]);
  const double z_error = std::abs(z_state_->position - target[1]);
  if (x_error <= configuration.arrived && z_error <= configuration.arrived) {
    end(GantryOutcome::done);
  } else if (seconds(now - settles_since_) > configuration.settle_timeout) {
    const bool is_x = x_error > configuration.arrived;
    end(GantryOutcome::failed,
        Status::error(StatusCode::timeout, "%s does not arrive: it is %.1f mm from its target",
                      is_x ? x->name() : z->name(), (is_x ? x_error : z_error) * 1e3));
  }
}

void Gantry::end(GantryOutcome outcome, const Status& cause) noexcept {
  phase_ = Phase::resting;
  outcome_ = outcome;
  trouble_ = cause;
}

void Gantry::seed_from_drives() noexcept {
  if (x_state_ && z_state_) path_.seed({x_state_->position, z_state_->position});
}

/// Since the cycle before, in s.
double Gantry::elapsed_in(const Tick& tick) noexcept {
  const double elapsed = last_cycle_ == Time{} ? 0.0 : seconds(tick.nominal - last_cycle_);
  last_cycle_ = tick.nominal;
  return std::clamp(elapsed, 0.0, configuration.longest_advance);
}

void Gantry::command() noexcept {
  const bool homes =
      phase_ == Phase::homing_first || phase_ == Phase::homing_second || phase_ == Phase::homing_ends;
  if (homes) return;  // the drives move by themselves
  x->command_position(path_.point()[0]);
  z->command_position(path_.point()[1]);
}

/// A position is as old as what the drives told last.
void Gantry::publish(const Tick& tick) noexcept {
  GantryState now{};
  Time sampled_at = tick.now;
  if (x_state_ && z_state_) {
    sampled_at = std::min(x_state_->measured_at, z_state_->measured_at);
    now.position = {x_state_->position, z_state_->position};
    now.known = true;
    now.enabled = x_state_->enabled && z_state_->enabled;
    now.homed = x_state_->homing == ServoHoming::homed && z_state_->homing == ServoHoming::homed;
  }
  now.order = taken_.number;
  now.outcome = outcome_;
  now.set_trouble(!hindrance_ ? hindrance_.cause() : trouble_.cause());
  state.publish(now, sampled_at);

  feedback.position = now.position;
  feedback.set_point = path_.point();
  feedback.moving = phase_ != Phase::resting;
  feedback.homed = now.homed;
  feedback.set_trouble(!hindrance_ ? hindrance_.cause() : trouble_.cause());
}

}  // namespace flexrf::user
