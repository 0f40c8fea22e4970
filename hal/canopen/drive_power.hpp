// The state machine of a CiA 402 drive, led from where the drive says it is to where it shall be.
#pragma once

#include "base/status.hpp"
#include "base/time.hpp"
#include "hal/canopen/cia402.hpp"

namespace flexrf::canopen::cia402 {

/// Nothing is assumed: each controlword follows from the statusword before it, and each hop has a time-out.
/// One thread; never blocks, never allocates.
class DrivePower {
 public:
  enum class Goal : std::uint8_t {
    off,      ///< a quick stop if it moves, then without torque
    enabled,  ///< operation enabled
  };

  struct Limits {
    Duration hop = std::chrono::milliseconds(500);      ///< for each hop but these:
    Duration enable = std::chrono::seconds(1);          ///< from switched on to enabled: the brake opens
    Duration stop = std::chrono::seconds(5);            ///< a quick stop, until it is at rest
    Duration fault_reaction = std::chrono::seconds(5);  ///< until the drive is in fault
    unsigned fault_resets = 3;                          ///< tries to leave a fault before it is told
  };

  void begin(const Limits& limits) noexcept;

  /// What is wanted from now on. Asking for `enabled` when something else was wanted is a new attempt:
  /// problem() is forgotten, and faults that are there may be reset. A drive that was enabled and faults or
  /// drops out is a problem: nothing enables it again by itself. One that was on its way to off goes there
  /// first: what it still says of its operation may be from before it was told.
  void pursue(Goal goal) noexcept;

  /// Once for each cycle: the controlword to send, without the bits of the mode. `at_rest`: the drive's
  /// velocity is zero; ends a quick stop that the drive does not end itself.
  std::uint16_t advance(std::uint16_t statusword, bool at_rest, Time now) noexcept {
    if (!holds_ || statusword != statusword_) return lead(statusword, at_rest, now);
    just_enabled_ = false;
    return command::enable_operation;
  }

  DriveState state() const noexcept { return state_; }
  Goal goal() const noexcept { return goal_; }
  bool is_enabled() const noexcept {
    return heading() == Goal::enabled && problem_.is_ok() && state_ == DriveState::operation_enabled;
  }
  /// True in the cycle in which is_enabled() became true: set-points are seeded now.
  bool was_just_enabled() const noexcept { return just_enabled_; }
  bool is_off() const noexcept { return observed_ && !has_torque(state_); }
  /// What keeps the drive from its goal, for a person. Without the drive's own reason: see its emergencies.
  const Status& problem() const noexcept { return problem_; }
  /// Since this attempt began.
  unsigned fault_resets() const noexcept { return fault_resets_; }

 private:
  enum class Reset : std::uint8_t { lower, raise, wait };

  Goal heading() const noexcept { return leaving_ ? Goal::off : goal_; }
  std::uint16_t lead(std::uint16_t statusword, bool at_rest, Time now) noexcept;
  void observe(std::uint16_t statusword, Time now) noexcept;
  std::uint16_t towards_enabled() noexcept;
  std::uint16_t towards_off(bool at_rest) const noexcept;
  std::uint16_t reset_fault(Time now) noexcept;
  void judge(Time now) noexcept;
  Duration time_for_hop() const noexcept;

  Limits limits_;
  Goal goal_ = Goal::off;
  DriveState state_ = DriveState::unknown;
  std::uint16_t statusword_ = 0;
  bool observed_ = false;     // a statusword was seen since begin()
  bool new_attempt_ = true;   // the next statusword begins a hop, whatever it says
  bool was_enabled_ = false;  // in this attempt
  bool just_enabled_ = false;
  bool holds_ = false;    // enabled as it shall be: while it says the same, there is nothing to judge
  bool leaving_ = false;  // it was told to go off, and has not said that it is
  Time since_{};          // the hop under way began
  Reset reset_ = Reset::lower;
  unsigned fault_resets_ = 0;
  Status problem_;
};

}  // namespace flexrf::canopen::cia402
