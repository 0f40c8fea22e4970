#include "hal/canopen/drive_power.hpp"

namespace flexrf::canopen::cia402 {
namespace {

// Where each way to off ends, and none begins: what is commanded there does nothing.
bool ends_the_way_off(DriveState state) noexcept {
  return state == DriveState::switch_on_disabled || state == DriveState::not_ready ||
         state == DriveState::fault;
}

}  // namespace

void DrivePower::begin(const Limits& limits) noexcept {
  *this = DrivePower{};
  limits_ = limits;
}

void DrivePower::pursue(Goal goal) noexcept {
  if (goal == goal_) return;
  goal_ = goal;
  holds_ = false;
  new_attempt_ = true;
  was_enabled_ = false;
  fault_resets_ = 0;
  reset_ = Reset::lower;
  problem_ = {};
}

std::uint16_t DrivePower::lead(std::uint16_t statusword, bool at_rest, Time now) noexcept {
  observe(statusword, now);
  judge(now);
  if (!problem_.is_ok()) {
    // What moves is stopped first; what did not stop in time, or does not do as it is told, loses its
    // voltage.
    const bool moves =
        !at_rest && (state_ == DriveState::operation_enabled || state_ == DriveState::quick_stop_active);
    return moves && goal_ == Goal::enabled ? command::quick_stop : command::disable_voltage;
  }
  if (heading() == Goal::off) {
    leaving_ = !ends_the_way_off(state_);
    return towards_off(at_rest);
  }
  if (state_ == DriveState::fault) return reset_fault(now);
  return towards_enabled();
}

void DrivePower::observe(std::uint16_t statusword, Time now) noexcept {
  const DriveState before = state_;
  statusword_ = statusword;
  holds_ = false;
  state_ = state_of(statusword);
  if (ends_the_way_off(state_)) leaving_ = false;
  if (!observed_ || new_attempt_ || state_ != before) since_ = now;
  observed_ = true;
  new_attempt_ = false;
  just_enabled_ = heading() == Goal::enabled && problem_.is_ok() && !was_enabled_ &&
                  state_ == DriveState::operation_enabled;
  if (just_enabled_) was_enabled_ = true;
}

void DrivePower::judge(Time now) noexcept {
  if (!problem_.is_ok()) return;
  if (was_enabled_ && state_ != DriveState::operation_enabled) {
    const bool faulted = state_ == DriveState::fault || state_ == DriveState::fault_reaction;
    problem_ = faulted ? Status::error(StatusCode::device_fault, "the drive is in fault (statusword %04X)",
                                       unsigned{statusword_})
                       : Status::error(
                             StatusCode::device_fault,
                             "the drive left its operation by itself: it is '%s' (statusword %04X); is its "
                             "supply off, a limit switch or safe torque off active?",
                             name_of(state_), unsigned{statusword_});
    return;
  }
  const bool is_there = goal_ == Goal::off ? is_off() : !leaving_ && state_ == DriveState::operation_enabled;
  const bool resets = goal_ == Goal::enabled && state_ == DriveState::fault;  // counts for itself
  if (is_there || resets || now - since_ <= time_for_hop()) return;
  problem_ = Status::error(StatusCode::timeout,
                           "the drive stays '%s' for more than %lld ms (statusword %04X) on its way to %s",
                           name_of(state_), static_cast<long long>(time_for_hop().count() / 1'000'000),
                           unsigned{statusword_}, heading() == Goal::enabled ? "operation" : "off");
}

Duration DrivePower::time_for_hop() const noexcept {
  switch (state_) {
    case DriveState::switched_on:
      return limits_.enable;
    case DriveState::operation_enabled:  // on the way to off: until it answers the quick stop, or has done it
    case DriveState::quick_stop_active:
      return limits_.stop;
    case DriveState::fault_reaction:
      return limits_.fault_reaction;
    default:
      return limits_.hop;
  }
}

std::uint16_t DrivePower::towards_enabled() noexcept {
  reset_ = Reset::lower;
  switch (state_) {
    case DriveState::switch_on_disabled:
      return command::shutdown;
    case DriveState::ready_to_switch_on:
      return command::switch_on;
    case DriveState::operation_enabled:
      holds_ = true;
      return command::enable_operation;
    case DriveState::switched_on:
      return command::enable_operation;
    default:
      // Out of a quick stop the way is through off; the others are left by the drive alone.
      return command::disable_voltage;
  }
}

std::uint16_t DrivePower::towards_off(bool at_rest) const noexcept {
  if (state_ == DriveState::operation_enabled) return command::quick_stop;
  if (state_ == DriveState::quick_stop_active && !at_rest) return command::quick_stop;
  return command::disable_voltage;
}

// Bit 7 acts when it rises: it is low for a cycle before each try.
std::uint16_t DrivePower::reset_fault(Time now) noexcept {
  switch (reset_) {
    case Reset::lower:
      if (fault_resets_ == limits_.fault_resets) {
        problem_ =
            Status::error(StatusCode::device_fault,
                          "the drive is still in fault after %u resets (statusword %04X): its cause is "
                          "still there",
                          fault_resets_, unsigned{statusword_});
        return command::disable_voltage;
      }
      reset_ = Reset::raise;
      return command::disable_voltage;
    case Reset::raise:
      reset_ = Reset::wait;
      ++fault_resets_;
      since_ = now;
      return command::fault_reset;
    case Reset::wait:
      if (now - since_ > limits_.hop) reset_ = Reset::lower;
      return command::fault_reset;
  }
  return command::disable_voltage;
}

}  // namespace flexrf::canopen::cia402
