// CanopenArm: an arm of CiA 402 drives on a CAN bus.
#pragma once

#include "canopen_arm_driver.hpp"
#include "hal/robot_arm/of_drives/arm_of_drives.hpp"
#include "hal/servo_drive/canopen/canopen_servo_drive.hpp"

namespace flexrf {

class CanopenArm final : public ArmOfDrives<CanopenArmDriver, CanopenServoDrive> {
 protected:
  Status configure(std::size_t joint, CanopenServoDriveConfiguration& drive) override;
};

}  // namespace flexrf
