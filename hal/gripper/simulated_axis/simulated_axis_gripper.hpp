// SimulatedAxisGripper: the CANopen master's gripper, and at the other end of a simulated bus the drive.
#pragma once

#include "hal/gripper/canopen/axis_gripper.hpp"
#include "hal/servo_drive/canopen/simulator/drive_on_can.hpp"
#include "simulated_axis_gripper_driver.hpp"

namespace flexrf {

/// Its bus has to be a simulated one, whose wire the drive is attached to. The fingers are open at first, and
/// stay where they are over a stop() and an initialise(); the drive is switched off and on.
class SimulatedAxisGripper final : public AxisGripper<SimulatedAxisGripperDriver> {
 public:
  static constexpr double increments = 1e6;  ///< of a metre of opening

  Status initialise() override;
  void stop() override;

  /// For faults on purpose, after initialise(): between the bus's cycles, from its thread.
  DriveOnCan& far_end() noexcept { return *far_end_; }

 private:
  std::optional<DriveOnCan> far_end_;
};

}  // namespace flexrf
