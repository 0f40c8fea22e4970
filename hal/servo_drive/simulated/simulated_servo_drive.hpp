// SimulatedServoDrive: the CANopen master's axis, and at the other end of a simulated bus the drive.
#pragma once

#include "hal/canopen/canopen_drive.hpp"
#include "hal/servo_drive/canopen/simulator/drive_on_can.hpp"
#include "simulated_servo_drive_driver.hpp"

namespace flexrf {

/// Its bus has to be a simulated one, whose wire the drive is attached to. The axis stays where it is over a
/// stop() and an initialise(), the drive is switched off and on.
class SimulatedServoDrive final : public CanopenDrive<SimulatedServoDriveDriver> {
 public:
  Status initialise() override;
  void stop() override;

  /// For faults on purpose, after initialise(): between the bus's cycles, from its thread.
  DriveOnCan& far_end() noexcept { return *far_end_; }

 private:
  std::optional<DriveOnCan> far_end_;
};

}  // namespace flexrf
