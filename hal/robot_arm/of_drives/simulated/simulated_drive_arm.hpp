// SimulatedDriveArm: an arm of simulated CiA 402 drives on a simulated bus.
#pragma once

#include "hal/robot_arm/of_drives/arm_of_drives.hpp"
#include "hal/servo_drive/simulated/simulated_servo_drive.hpp"
#include "simulated_drive_arm_driver.hpp"

namespace flexrf {

/// Its joints are in their home postures at first.
class SimulatedDriveArm final : public ArmOfDrives<SimulatedDriveArmDriver, SimulatedServoDrive> {
 protected:
  Status configure(std::size_t joint, SimulatedServoDriveConfiguration& drive) override;
};

}  // namespace flexrf
