// An axis of a CiA 402 drive and its place on a CAN bus.
#pragma once

#include "hal/can/interface/can_bus.hpp"
#include "hal/canopen/servo_axis.hpp"
#include "hal/servo_drive/interface/servo_drive.hpp"
#include "runtime/unit/tick.hpp"

namespace flexrf::canopen {

/// Each axis says SYNC and our heartbeat; the bus sends what several say in a cycle once. It is brought up in
/// the thread that it lives in, an answer in each cycle: open() does not wait for it, and a drive that is
/// switched on later comes up then.
///
/// In each cycle it prepares on the bus what stops the axis should this process die: the axis's last word,
/// and SYNC, at which the drive takes it. A bus that says nothing then leaves it to the drive, which no
/// longer hears our heartbeat.
class AxisOnBus {
 public:
  /// The lifecycle thread. Error: the plan makes no sense, the bus has no place, or its node is another
  /// device's. `name`: of the device; lives for ever.
  Status open(const cia402::AxisPlan& plan, CanBus& bus, const char* name);
  void close();

  /// The thread that the bus lives in; never block, never allocate.
  void receive(const Tick& tick) noexcept;
  void send(const Tick& tick, bool may_move) noexcept;
  /// Likewise: with the next receive() the node is brought up anew, and the axis's fault is forgotten.
  void begin_again() noexcept { began_ = false; }

  /// Likewise, behind receive(): says in the log, once, that the drive has ramps of its own, and that its
  /// quick stop lets the axis coast. `name`: of the device; lives for ever.
  void tell_oddities(const char* name) noexcept;

  cia402::ServoAxis& axis() noexcept { return axis_; }
  const cia402::ServoAxis& axis() const noexcept { return axis_; }
  /// As ServoDrive says it.
  std::optional<ServoState> state() const noexcept;
  ServoHoming homing() const noexcept;

 private:
  cia402::AxisPlan plan_;
  cia402::ServoAxis axis_;
  Outbox outbox_;
  CanInbox inbox_;
  CanBus* bus_ = nullptr;
  const char* name_ = "";
  int last_word_ = CanBus::no_last_word;  // its place
  bool began_ = false;
  bool told_oddities_ = false;  // since open()
  Time last_sent_{};
};

cia402::Mode mode_of(ServoMode mode) noexcept;

}  // namespace flexrf::canopen
