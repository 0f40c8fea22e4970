// How an axis of CiA 402 is led as a gripper: it is sent with a profile and a limited torque, and what stops
// it before is an object.
#pragma once

#include "hal/canopen/axis_on_bus.hpp"
#include "hal/gripper/interface/gripper.hpp"

namespace flexrf::canopen {

struct GripperAxisPlan {
  double open_width = 0.085;   ///< m
  double closed_width = 0;     ///< m
  double opening_at_zero = 0;  ///< m, where the axis's position is 0
  double speed = 0.05;         ///< m/s, where a goal has none
  double force = 40;           ///< N, likewise
  double weakest = 10;         ///< N, that it is told
  double strongest = 100;      ///< N, likewise
  double rated_force = 100;    ///< N, of the fingers at the motor's rated torque
  double grip_share = 0.7;     ///< of the torque's limit: at rest with so much, it presses
  double slip = 0.003;         ///< m: fingers that moved on so far have lost what they held
  Duration grip_time = std::chrono::milliseconds(100);  ///< pressing for so long, it grips
  Duration travel_timeout = std::chrono::seconds(3);
  Duration activation_timeout = std::chrono::seconds(10);
};

/// Position of the axis: m of opening. It has power from its activation on, also while nothing may move: what
/// it holds stays held. One thread; never blocks, never allocates, but for open() and close(): the lifecycle
/// thread. A cycle: receive(), then commands, then send().
class GripperAxis {
 public:
  /// `axis`: its mode and range follow from `plan`. Error: a plan makes no sense, or the bus has no place.
  Status open(const GripperAxisPlan& plan, const cia402::AxisPlan& axis, CanBus& bus, const char* name);
  void close() { link_.close(); }

  void receive(const Tick& tick) noexcept;
  /// See AxisOnBus.
  void tell_oddities(const char* name) noexcept { link_.tell_oddities(name); }
  void send(const Tick& tick) noexcept { link_.send(tick, has_power_); }

  /// Enables the drive, resets its fault before, and homes it where it does not know where it is.
  void activate() noexcept;
  /// A goal within reach; see Gripper.
  void command(const GripperGoal& goal) noexcept;
  /// Ends what it is at; what it holds stays held. An activation is given up, the drive is off then.
  void halt() noexcept;
  /// Nothing is under way, and the drive says that it stands, or that it is off where it is to have no power.
  bool is_at_rest() const noexcept;
  bool is_active() const noexcept;

  const std::optional<GripperState>& state() const noexcept { return state_; }
  const Status& trouble() const noexcept { return trouble_; }

 private:
  enum class Phase : std::uint8_t { idle, clearing, enabling, homing, going, halting };

  bool activates() const noexcept;
  double opening() const noexcept;
  void enter(Phase phase) noexcept;
  void limit_force(double force) noexcept;
  void drop() noexcept;
  void follow() noexcept;
  void watch_rest(const cia402::AxisState& axis) noexcept;
  bool rests_for(Duration time) const noexcept;
  void follow_homing() noexcept;
  void follow_goal() noexcept;
  void grip() noexcept;
  void check_time() noexcept;
  void renew() noexcept;
  Status find_trouble() const noexcept;

  GripperAxisPlan plan_;
  cia402::AxisPlan axis_plan_;
  AxisOnBus link_;
  Phase phase_ = Phase::idle;
  bool has_power_ = false;  // it is wanted
  Time now_{};
  Time began_{};                     // what it is at
  std::optional<Time> still_since_;  // at rest, and while it goes somewhere pressing
  GripperGoal goal_;
  double most_torque_ = 1;  // of the rated torque
  bool closes_ = false;
  double gripped_at_ = 0;
  GripperObject object_ = GripperObject::unknown;
  Status latched_;  // until the next command or activation
  std::optional<GripperState> state_;
  Status trouble_;
};

}  // namespace flexrf::canopen
