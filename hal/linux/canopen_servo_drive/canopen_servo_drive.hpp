// CanopenServoDrive: a CiA 402 drive on a CAN bus.
#pragma once

#include "canopen_servo_drive_driver.hpp"
#include "hal/canopen/servo_axis.hpp"
#include "hal/interfaces/can_bus/can_bus.hpp"
#include "hal/interfaces/servo_drive/servo_drive.hpp"

namespace flexrf {

/// Each drive says SYNC and our heartbeat; the bus sends what several say in a cycle once. It is brought up
/// in the thread that it lives in, an answer in each cycle: initialise() does not wait for it, and a drive
/// that is switched on later comes up then.
class CanopenServoDrive final : public CanopenServoDriveDriver {
 public:
  Status initialise() override;
  void stop() override;
  void receive(const Tick& tick) noexcept override;
  void send(const Tick& tick) noexcept override;
  bool make_safe() noexcept override;

  std::optional<ServoState> state() const noexcept override;
  void command_position(double position) noexcept override;
  void command_velocity(double velocity) noexcept override;

 private:
  canopen::cia402::AxisPlan plan_from_configuration() const noexcept;

  canopen::cia402::AxisPlan plan_;
  canopen::cia402::ServoAxis axis_;
  canopen::Outbox outbox_;
  CanInbox inbox_;
  bool began_ = false;
  bool made_safe_ = false;  // until the permission to move was withdrawn
  Time last_sent_{};
};

}  // namespace flexrf
