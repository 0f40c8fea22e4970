// The simulated drive's state machine and modes (CiA 402).
#include "hal/canopen/cia402.hpp"
#include "hal/servo_drive/canopen/simulator/simulated_cia402_drive.hpp"

namespace flexrf {
namespace {

using canopen::Outbox;
using canopen::cia402::DriveState;
using canopen::cia402::Mode;
namespace axis = canopen::cia402::objects;
namespace control_bit = canopen::cia402::control_bit;
namespace status_bit = canopen::cia402::status_bit;

constexpr double longest_step = 0.1;  // s; what is slept through beyond it is not moved
constexpr double fault_deceleration = 400000;
constexpr std::int64_t friction_torque = 50;  // of 1000

constexpr std::uint16_t bits_of(DriveState state) {
  switch (state) {
    case DriveState::switch_on_disabled:
      return 0x0040;
    case DriveState::ready_to_switch_on:
      return 0x0021;
    case DriveState::switched_on:
      return 0x0033;
    case DriveState::operation_enabled:
      return 0x0037;
    case DriveState::quick_stop_active:
      return 0x0017;
    case DriveState::fault_reaction:
      return 0x001F;
    case DriveState::fault:
      return 0x0018;
    default:
      return 0x0000;
  }
}

}  // namespace

void SimulatedCia402Drive::enter(DriveState state, Time now) {
  if (state == state_ || stuck_ == state_) return;
  state_ = state;
  entered_ = now;
  mode_bits_ = 0;
  if (state == DriveState::operation_enabled) {
    targets_fresh_ = false;
    profile_target_ = motion_.position();
  }
  publish();
}

// In another mode it stays where it is, until it is told something in that one.
void SimulatedCia402Drive::take_mode() {
  if (ignores_mode_) return;
  const std::int64_t mode = objects_.get_signed(axis::mode);
  if (mode == objects_.get_signed(axis::mode_display)) return;
  if (mode > 0 && (objects_.get(axis::supported_modes) >> (mode - 1) & 1) == 0) return;
  objects_.set(axis::mode_display, mode);
  mode_bits_ = 0;
  targets_fresh_ = false;
  profile_target_ = motion_.position();
}

// Transitions that the controlword asks for.
void SimulatedCia402Drive::command(Time now, Outbox& outbox) {
  const auto word = static_cast<std::uint16_t>(objects_.get(axis::controlword));
  const auto risen = static_cast<std::uint16_t>(word & ~last_command_);
  last_command_ = word;
  take_mode();
  const bool shutdown = (word & 0x87) == 0x06;
  const bool switch_on = (word & 0x8F) == 0x07;
  const bool enable = (word & 0x8F) == 0x0F;
  const bool disable_voltage = (word & 0x82) == 0x00;
  const bool quick_stop = (word & 0x86) == 0x02;
  const auto mode = static_cast<Mode>(objects_.get_signed(axis::mode));
  switch (state_) {
    case DriveState::switch_on_disabled:
      if (shutdown) {
        if (!master_lost_) end(Error::heartbeat, outbox);
        enter(DriveState::ready_to_switch_on, now);
      }
      break;
    case DriveState::ready_to_switch_on:
      if (disable_voltage || quick_stop) enter(DriveState::switch_on_disabled, now);
      if (switch_on || enable) enter(DriveState::switched_on, now);
      break;
    case DriveState::switched_on:
      if (disable_voltage || quick_stop) enter(DriveState::switch_on_disabled, now);
      if (shutdown) enter(DriveState::ready_to_switch_on, now);
      if (enable && now - entered_ >= options_.brake_delay) enter(DriveState::operation_enabled, now);
      break;
    case DriveState::operation_enabled:
      if (switch_on) enter(DriveState::switched_on, now);
      if (shutdown) enter(DriveState::ready_to_switch_on, now);
      if (disable_voltage) enter(DriveState::switch_on_disabled, now);
      if (quick_stop) enter(DriveState::quick_stop_active, now);
      // Bit 4 is each mode's own.
      if ((risen & control_bit::new_set_point) != 0 && mode == Mode::profile_position) {
        const std::int64_t told = objects_.get_signed(axis::target_position);
        const bool is_relative = (word & control_bit::relative) != 0;
        profile_target_ = is_relative ? profile_target_ + static_cast<double>(told) : place_of(told);
        profile_speed_ = static_cast<double>(objects_.get(axis::profile_velocity));
        ++set_points_;
        mode_bits_ = status_bit::set_point_acknowledged;
      }
      if ((risen & control_bit::start_homing) != 0 && mode == Mode::homing) mode_bits_ = 0;
      if (mode == Mode::profile_position && (word & control_bit::new_set_point) == 0) {
        mode_bits_ &= static_cast<std::uint16_t>(~status_bit::set_point_acknowledged);
      }
      break;
    case DriveState::quick_stop_active:
      if (disable_voltage) enter(DriveState::switch_on_disabled, now);
      break;
    case DriveState::fault:
      if ((risen & 0x80) != 0 && !cause_persists_) {
        objects_.set(axis::error_code, 0);
        end(Error::fault, outbox);
        enter(DriveState::switch_on_disabled, now);
      }
      break;
    default:
      break;
  }
  publish();
}

void SimulatedCia402Drive::move(Time now, Outbox& outbox) {
  const double time = std::min(seconds(now - moved_), longest_step);
  if (time <= 0) return;
  moved_ = now;
  presses_ = 0;
  if (is_cut_) motion_.brake();
  switch (state_) {
    case DriveState::operation_enabled:
      if (is_cut_) break;
      move_in_mode(time, outbox);
      meet_obstacles();
      break;
    case DriveState::quick_stop_active:
      motion_.ramp(0, static_cast<double>(objects_.get(axis::quick_stop_deceleration)), time);
      // Options 1 to 4 end in off, 5 to 8 stay here.
      if (motion_.is_at_rest() && objects_.get_signed(axis::quick_stop_option) < 5) {
        enter(DriveState::switch_on_disabled, now);
      }
      break;
    case DriveState::fault_reaction:
      motion_.ramp(0, fault_deceleration, time);
      if (motion_.is_at_rest()) enter(DriveState::fault, now);
      break;
    default:
      motion_.brake();
      break;
  }
  publish();
}

void SimulatedCia402Drive::meet_obstacles() {
  const double goes = motion_.position();
  if (below_ && goes < *below_) presses_ = -1;
  if (above_ && goes > *above_) presses_ = 1;
  if (presses_ == 0) return;
  motion_.stop_at(presses_ < 0 ? *below_ : *above_);
  // It is where it was sent, or at home, on the other side.
  mode_bits_ &= static_cast<std::uint16_t>(~status_bit::target_reached);
}

void SimulatedCia402Drive::move_in_mode(double time, Outbox& outbox) {
  const auto word = static_cast<std::uint16_t>(objects_.get(axis::controlword));
  const auto acceleration = static_cast<double>(objects_.get(axis::profile_acceleration));
  const auto mode = static_cast<Mode>(objects_.get_signed(axis::mode));
  const bool halts = (word & control_bit::halt) != 0;
  if (halts && mode != Mode::cyclic_position && mode != Mode::cyclic_velocity) {
    motion_.ramp(0, acceleration, time);
    return;
  }
  if (!targets_fresh_) {
    motion_.ramp(0, acceleration, time);
    return;
  }
  switch (mode) {
    case Mode::cyclic_position:
      if (ignores_set_points_) return stay(acceleration, time);
      mode_bits_ = status_bit::follows;
      follow_cyclic_target(time, outbox);
      break;
    case Mode::interpolated_position:
      if (!interpolates()) return stay(acceleration, time);
      mode_bits_ = status_bit::interpolates;
      follow_cyclic_target(time, outbox);
      break;
    case Mode::cyclic_velocity:
    case Mode::profile_velocity: {
      if (ignores_set_points_ && mode == Mode::cyclic_velocity) return stay(acceleration, time);
      const auto wanted = static_cast<double>(objects_.get_signed(axis::target_velocity));
      const double velocity = std::clamp(wanted, -options_.fastest, options_.fastest);
      motion_.ramp(velocity, acceleration, time);
      const bool cyclic = mode == Mode::cyclic_velocity;
      mode_bits_ = cyclic ? status_bit::follows : 0;
      if (!cyclic && motion_.is_at_rest()) mode_bits_ |= status_bit::speed_is_zero;
      if (!cyclic && motion_.velocity() == velocity) mode_bits_ |= status_bit::target_reached;
      if (velocity != wanted) mode_bits_ |= status_bit::internal_limit;
      break;
    }
    case Mode::profile_position:
      mode_bits_ &= static_cast<std::uint16_t>(~status_bit::target_reached);
      if (motion_.travel(profile_target_, profile_speed_, acceleration, time)) {
        mode_bits_ |= status_bit::target_reached;
      }
      break;
    case Mode::homing:
      find_home((word & control_bit::start_homing) != 0, acceleration, time);
      break;
    case Mode::none:
      break;
  }
}

// Enabled, and not led.
void SimulatedCia402Drive::stay(double acceleration, double time) {
  mode_bits_ = 0;
  motion_.ramp(0, acceleration, time);
}

// In a straight line through the period: linear interpolation, which is object 60C0 at 0.
void SimulatedCia402Drive::follow_cyclic_target(double time, Outbox& outbox) {
  const double target = cyclic_target();
  if (cyclic_speed_ > options_.fastest) mode_bits_ |= status_bit::internal_limit;
  motion_.follow(target, std::min(cyclic_speed_, options_.fastest), time);
  const double error = std::abs(target - motion_.position());
  objects_.set(axis::following_error, static_cast<std::int64_t>(target - motion_.position()));
  if (error <= static_cast<double>(objects_.get(axis::following_window))) return;
  mode_bits_ |= status_bit::following_error;
  trip(0x8611, false, outbox);
}

// Methods 35 and 37 are at home where they are; for all others it is at 0.
void SimulatedCia402Drive::find_home(bool started, double acceleration, double time) {
  const std::int64_t method = objects_.get_signed(axis::homing_method);
  if (!started) {
    motion_.ramp(0, acceleration, time);
    if (motion_.is_at_rest()) mode_bits_ |= status_bit::target_reached;
    // Of the run before, as drives do.
    if (was_homed_) mode_bits_ |= status_bit::homing_attained;
    return;
  }
  was_homed_ = false;
  if (homeless_) {
    motion_.ramp(0, acceleration, time);
    mode_bits_ = status_bit::homing_error;
    if (motion_.is_at_rest()) mode_bits_ |= status_bit::target_reached;
    return;
  }
  mode_bits_ = 0;
  if (method == 35 || method == 37) motion_.set_position(0);
  if (motion_.travel(0, static_cast<double>(objects_.get(axis::homing_search_speed)), acceleration, time)) {
    mode_bits_ = status_bit::target_reached | status_bit::homing_attained;
    was_homed_ = true;
  }
}

void SimulatedCia402Drive::publish() {
  objects_.set(axis::statusword, bits_of(state_) | mode_bits_);
  objects_.set(axis::actual_position, std::llround(motion_.position()));
  objects_.set(axis::actual_velocity, std::llround(motion_.velocity()));
  const auto most_torque = static_cast<std::int64_t>(objects_.get(axis::most_torque));
  const bool turns = state_ == DriveState::operation_enabled && !motion_.is_at_rest();
  const std::int64_t friction = turns ? std::min(most_torque, friction_torque) : 0;
  objects_.set(axis::actual_torque, presses_ != 0            ? presses_ * most_torque
                                    : motion_.velocity() < 0 ? -friction
                                                             : friction);
}

}  // namespace flexrf
