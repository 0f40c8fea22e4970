// Drivers that the tests of the station reach into. They have functions of their own that are called fail,
// for which CMocka has a macro.
#pragma once

#pragma push_macro("fail")
#undef fail
#include "drivers/feeder_station/feeder_station.hpp"
#include "hal/camera/mock/mock_camera.hpp"
#include "hal/camera/simulated/simulated_camera.hpp"
#include "hal/can/in_process/in_process_can_bus.hpp"
#include "hal/gripper/mock/mock_gripper.hpp"
#include "hal/gripper/simulated/simulated_gripper.hpp"
#include "hal/modbus/link/simulated/simulated_modbus_link.hpp"
#include "hal/modbus/station/mock/mock_modbus_station.hpp"
#include "hal/servo_drive/mock/mock_servo_drive.hpp"
#include "hal/servo_drive/simulated/simulated_servo_drive.hpp"
#pragma pop_macro("fail")
