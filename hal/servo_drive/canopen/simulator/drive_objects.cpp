#include "hal/servo_drive/canopen/simulator/drive_objects.hpp"

#include "hal/canopen/cia402.hpp"
#include "hal/canopen/message.hpp"

namespace flexrf {
namespace {

namespace axis = canopen::cia402::objects;

}  // namespace

DriveObjects::DriveObjects() {
  add(canopen::objects::device_type, 4, false, false, 0x00020192);
  add(canopen::objects::error_register, 1, false, false);
  add(canopen::objects::sync, 4, true, false, canopen::sync_identifier);
  add(canopen::objects::guard_time, 2, true, false);
  add(canopen::objects::life_time_factor, 1, true, false);
  add(canopen::objects::consumer_heartbeat, 4, true, false);
  add(canopen::objects::producer_heartbeat, 2, true, false);
  add(canopen::objects::vendor, 4, false, false, 0x00000123);
  add(canopen::objects::product, 4, false, false, 0x00000456);
  add_pdos();
  add(axis::abort_connection, 2, true, false, 1);
  add(axis::error_code, 2, false, true);
  add(axis::controlword, 2, true, true);
  add(axis::statusword, 2, false, true);
  add(axis::quick_stop_option, 2, true, false, 2);
  add(axis::mode, 1, true, true);
  add(axis::mode_display, 1, false, true);
  add(axis::actual_position, 4, false, true);
  add(axis::following_window, 4, true, false, 0xFFFFFFFF);
  add(axis::actual_velocity, 4, false, true);
  add(axis::most_torque, 2, true, true, 1000);
  add(axis::actual_torque, 2, false, true);
  add(axis::target_position, 4, true, true);
  add(axis::profile_velocity, 4, true, true, 10000);
  add(axis::profile_acceleration, 4, true, true, 100000);
  add(axis::profile_deceleration, 4, true, true, 100000);
  add(axis::quick_stop_deceleration, 4, true, false, 200000);
  add(axis::homing_method, 1, true, false, 35);
  add(axis::homing_search_speed, 4, true, false, 10000);
  add(axis::homing_creep_speed, 4, true, false, 1000);
  add(axis::interpolation_kind, 2, true, false);
  add(axis::interpolation_point, 4, true, true);
  add(axis::period_value, 1, true, false, 1);
  add(axis::period_exponent, 1, true, false, 0xFD);
  add(axis::following_error, 4, false, true);
  add(axis::target_velocity, 4, true, true);
  add(axis::supported_modes, 4, false, false, 0x01E5);
  sort();
}

}  // namespace flexrf
