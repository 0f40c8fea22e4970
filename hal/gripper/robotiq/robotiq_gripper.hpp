// RobotiqGripper: a Robotiq two-finger gripper on a Modbus link.
#pragma once

#include "hal/gripper/robotiq/robotiq_driver.hpp"
#include "robotiq_gripper_driver.hpp"

namespace flexrf {

class RobotiqGripper final : public robotiq::RobotiqDriver<RobotiqGripperDriver> {};

}  // namespace flexrf
