// Drivers that the tests of the station reach into. They have functions of their own that are called fail,
// for which CMocka has a macro.
#pragma once

#pragma push_macro("fail")
#undef fail
#include "drivers/feeder_station/feeder_station.hpp"
#include "hal/mock/mock_camera/mock_camera.hpp"
#include "hal/mock/mock_gripper/mock_gripper.hpp"
#include "hal/mock/mock_modbus_station/mock_modbus_station.hpp"
#include "hal/mock/mock_servo_drive/mock_servo_drive.hpp"
#include "hal/simulated/in_process_can_bus/in_process_can_bus.hpp"
#include "hal/simulated/simulated_camera/simulated_camera.hpp"
#include "hal/simulated/simulated_gripper/simulated_gripper.hpp"
#include "hal/simulated/simulated_modbus_link/simulated_modbus_link.hpp"
#include "hal/simulated/simulated_servo_drive/simulated_servo_drive.hpp"
#pragma pop_macro("fail")
