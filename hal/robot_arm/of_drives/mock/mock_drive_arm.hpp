// MockDriveArm: an arm of mock drives.
#pragma once

#include "hal/robot_arm/of_drives/arm_of_drives.hpp"
#include "hal/servo_drive/mock/mock_servo_drive.hpp"
#include "mock_drive_arm_driver.hpp"

namespace flexrf {

/// Its joints are at 0 at first. Tests script it through drive().
class MockDriveArm final : public ArmOfDrives<MockDriveArmDriver, MockServoDrive> {
 protected:
  Status configure(std::size_t joint, MockServoDriveConfiguration& drive) override {
    drive.homing_method = configuration.homing_methods[joint];
    drive.homing_speed = drive.fastest;
    return {};
  }
};

}  // namespace flexrf
