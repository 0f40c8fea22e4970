// An axis of a CiA 402 drive as a driver uses it: brought up, enabled, fed with cyclic set-points, and
// stopped.
#pragma once

#include "hal/canopen/drive_modes.hpp"
#include "hal/canopen/drive_power.hpp"
#include "hal/canopen/node.hpp"

namespace flexrf::canopen::cia402 {

/// "Unit": rad of a rotary axis, m of a linear one.
struct AxisPlan {
  std::uint8_t node = 1;
  std::uint8_t master = 127;
  std::uint32_t vendor = 0;                        ///< 0: any
  std::uint32_t product = 0;                       ///< 0: any
  Mode mode = Mode::cyclic_position;               ///< or cyclic_velocity
  Duration period = std::chrono::milliseconds(7);  ///< of SYNC and set-points; whole ms, at most 255
  double increments_per_unit = 1000;               ///< negative: it turns the other way; not 0
  double lowest = -1000;                           ///< position, unit
  double highest = 1000;                           ///< position, unit
  double fastest = 1;                              ///< unit/s, above 0
  double rest_velocity = 0.001;                    ///< unit/s: at most so fast is at rest
  std::int16_t abort_connection = 3;  ///< object 6007: what it does without our heartbeat: quick stop
  Duration mode_timeout = std::chrono::milliseconds(500);
  Duration boot_timeout = std::chrono::seconds(1);
  Duration sdo_timeout = std::chrono::milliseconds(500);
  Duration heartbeat_period = std::chrono::milliseconds(100);
  Duration heartbeat_limit = std::chrono::milliseconds(250);
  DrivePower::Limits limits;
};

struct AxisState {
  double position = 0;         ///< unit
  double velocity = 0;         ///< unit/s
  double following_error = 0;  ///< the last set-point less position, unit; 0 in other modes
  bool enabled = false;
  bool at_internal_limit = false;
};

/// Without I/O; never blocks, never allocates. One thread. A cycle: receive() of what came, then commands,
/// then send(). A fault stays until begin(): nothing is enabled again by itself.
class ServoAxis {
 public:
  /// Error: the plan makes no sense.
  Status begin(const AxisPlan& plan, Time now, Outbox& outbox) noexcept;
  /// The drive is to be off already; the node leaves its operation.
  void end(Outbox& outbox) noexcept;

  void receive(const Message& message, Time now, Outbox& outbox) noexcept;
  /// The end of the cycle, `elapsed` after the one before: set-points, SYNC, heartbeat. `may_move` false: it
  /// is stopped and off, and forgets what it was commanded.
  void send(bool may_move, Time now, Duration elapsed, Outbox& outbox) noexcept;

  /// In mode cyclic_position: unit, kept within lowest and highest. Held until the next one. Without effect
  /// while the axis is not enabled, and not remembered. What is not finite is a fault.
  void command_position(double position) noexcept;
  /// In mode cyclic_velocity: unit/s, kept within fastest; zero once the axis is beyond its range and would
  /// go on.
  void command_velocity(double velocity) noexcept;

  /// What the drive said last; nothing while it is not operational or says nothing.
  const std::optional<AxisState>& state() const noexcept { return state_; }
  bool is_enabled() const noexcept { return power_.is_enabled(); }
  /// It has no torque, or nobody hears it: then it has stopped by itself, if it does as it was told.
  bool is_off() const noexcept { return !node_.is_operational() || power_.is_off(); }
  /// What stopped it, for a person; ok while nothing did.
  const Status& fault() const noexcept { return fault_; }
  const Node& node() const noexcept { return node_; }

 private:
  static constexpr int silent_cycles = 10;  // without process data it is not known where it is

  Status check(const AxisPlan& plan) const noexcept;
  NodePlan node_plan() noexcept;
  void fail(const Status& cause) noexcept;
  void watch(Time now) noexcept;
  bool mode_is_taken(bool wanted, Time now) noexcept;
  double set_point_for(Duration elapsed) noexcept;

  AxisPlan plan_;
  Node node_;
  DrivePower power_;
  CyclicSetPoint cyclic_{1};
  PdoPlan commands_;
  PdoPlan states_;
  PdoPlan motion_;
  HeartbeatProducer beat_;
  std::optional<AxisState> state_;
  Status fault_;
  Time heard_{};
  std::optional<Time> mode_wanted_;
  std::uint16_t statusword_ = 0;
  Mode mode_shown_ = Mode::none;
  bool was_operational_ = false;
  std::uint64_t bring_ups_ = 0;
  double velocity_ = 0;               // commanded
  std::uint64_t last_set_point_ = 0;  // as it was sent
};

}  // namespace flexrf::canopen::cia402
