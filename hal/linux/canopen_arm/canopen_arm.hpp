// CanopenArm: an arm of CiA 402 drives on a CAN bus.
#pragma once

#include "canopen_arm_driver.hpp"
#include "hal/linux/canopen_servo_drive/canopen_servo_drive.hpp"
#include "hal/servo_group/arm_of_drives.hpp"

namespace flexrf {

class CanopenArm final : public ArmOfDrives<CanopenArmDriver, CanopenServoDrive> {
 protected:
  Status configure(std::size_t joint, CanopenServoDriveConfiguration& drive) override;
};

}  // namespace flexrf
