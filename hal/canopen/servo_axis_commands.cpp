// What a unit commands an axis.
#include <algorithm>
#include <cmath>
#include <limits>

#include "hal/canopen/servo_axis.hpp"
#include "hal/servo_drive/interface/servo_restraints.hpp"

namespace flexrf::canopen::cia402 {
void ServoAxis::command_position(double position) noexcept {
  if (!takes(Mode::cyclic_position, Mode::interpolated_position) || !may_be_commanded()) return;
  if (!is_number(position, "position")) return;
  held_ = {};
  cyclic_.command(plan_.endless
                      ? by_the_shorter_way(position, cyclic_.wanted())
                      : within(position, plan_.lowest, plan_.highest, servo_restraints::out_of_range));
}

void ServoAxis::command_velocity(double velocity) noexcept {
  if (!takes(Mode::cyclic_velocity, Mode::profile_velocity) || !may_be_commanded()) return;
  if (!is_number(velocity, "velocity")) return;
  held_ = {};
  const double kept = within(velocity, -plan_.fastest, plan_.fastest, servo_restraints::too_fast);
  if (kept == velocity_ && was_commanded_ && !halts_) return;
  velocity_ = kept;
  cycles_ = 0;
  was_commanded_ = true;
  halts_ = false;
  state_->target_reached = false;
}

void ServoAxis::move_to(double position, double speed) noexcept {
  if (!takes(Mode::profile_position, Mode::profile_position) || !may_be_commanded()) return;
  if (!is_number(position, "position") || !is_number(speed, "speed")) return;
  if (!(speed > 0)) {
    fail(Status::error(StatusCode::invalid_argument, "it was commanded to move with a speed of %g", speed));
    return;
  }
  held_ = {};
  // As fast as it may: nothing is held back.
  double kept_speed = plan_.fastest;
  if (speed != full_speed) {
    kept_speed = within(speed, 0, plan_.fastest, servo_restraints::too_fast);
    if (!plan_.tells_speed) held_ = {.reason = servo_restraints::own_speed, .asked = speed};
  }
  const double kept = plan_.endless
                          ? in_reach(by_the_shorter_way(position, way_))
                          : within(position, plan_.lowest, plan_.highest, servo_restraints::out_of_range);
  const auto target = static_cast<std::uint32_t>(std::llround(kept * plan_.increments_per_unit));
  handshake_.command(static_cast<std::int32_t>(target), kept_speed);
  was_commanded_ = true;
  state_->target_reached = false;
}

void ServoAxis::home() noexcept {
  if (!may_be_commanded()) return;
  if (plan_.homing_method == 0) {
    restraint_ = {.reason = servo_restraints::no_homing};
    return;
  }
  halt();
  homing_.start();
}

void ServoAxis::halt() noexcept {
  if (!power_.is_enabled() || !state_) return;
  homing_.halt();
  if (homing_.is_running()) return;
  cyclic_.brake();
  if (!plan_.changes_target_at_once && plan_.mode == Mode::profile_position)
    drops_target_ = drops_target_ || handshake_.may_be_under_way();
  handshake_.reset(handshake_.target());
  held_ = {};
  was_commanded_ = false;
  halts_ = true;
  state_->target_reached = false;
}

bool ServoAxis::may_be_commanded() const noexcept {
  return is_enabled() && state_ && !homing_.is_running();
}

bool ServoAxis::takes(Mode one, Mode other) noexcept {
  if (is_led_in(one, other)) return true;
  if (may_be_commanded()) restraint_ = {.reason = servo_restraints::another_mode};
  return false;
}

double ServoAxis::within(double value, double lowest, double highest, const char* reason) noexcept {
  const double kept = std::clamp(value, lowest, highest);
  if (kept != value) held_ = {reason, value, kept};
  return kept;
}

// Of all that are the same to a modulo.
double ServoAxis::by_the_shorter_way(double position, double from) const noexcept {
  return plan_.modulo > 0 ? from + std::remainder(position - from, plan_.modulo) : position;
}

// The drive's counter has run over half, and it would go there the other way round.
double ServoAxis::in_reach(double way) noexcept {
  constexpr double half_of_counter = std::numeric_limits<std::int32_t>::max();
  const double farthest = half_of_counter / std::abs(plan_.increments_per_unit);
  return within(way, way_ - farthest, way_ + farthest, servo_restraints::too_far);
}

bool ServoAxis::is_number(double value, const char* what) noexcept {
  if (std::isfinite(value)) return true;
  fail(Status::error(StatusCode::invalid_argument, "it was commanded to a %s that is not a number", what));
  return false;
}

}  // namespace flexrf::canopen::cia402
