#include "hal/linux/canopen_servo_drive/canopen_servo_drive.hpp"

namespace flexrf {

Status CanopenServoDrive::initialise() {
  using canopen::whole_milliseconds;
  canopen::cia402::AxisPlan plan = plan_from_interface();
  plan.node = configuration.node;
  plan.master = configuration.master;
  plan.vendor = configuration.vendor;
  plan.product = configuration.product;
  plan.period = whole_milliseconds(configuration.period);
  plan.increments_per_unit = configuration.increments_per_unit;
  plan.velocity_factor = configuration.velocity_factor;
  plan.acceleration_factor = configuration.acceleration_factor;
  plan.quick_stop_deceleration = configuration.quick_stop_deceleration;
  plan.rest_velocity = configuration.rest_velocity;
  plan.homing_creep_speed = configuration.homing_creep_speed;
  plan.homing_settle = whole_milliseconds(configuration.homing_settle);
  plan.abort_connection = configuration.abort_connection;
  plan.tells_abort_connection = configuration.tells_abort_connection;
  plan.tells_period = configuration.tells_period;
  plan.is_supervised_by_it = configuration.supervises_us;
  plan.forbids_remote = configuration.forbids_remote;
  plan.is_guarded = configuration.guarded;
  plan.maps_mode = configuration.maps_mode;
  plan.mode_timeout = whole_milliseconds(configuration.mode_timeout);
  plan.set_point_timeout = whole_milliseconds(configuration.set_point_timeout);
  plan.boot_timeout = whole_milliseconds(configuration.boot_timeout);
  plan.sdo_timeout = whole_milliseconds(configuration.sdo_timeout);
  plan.heartbeat_period = whole_milliseconds(configuration.heartbeat_period);
  plan.heartbeat_limit = whole_milliseconds(configuration.heartbeat_limit);
  plan.limits.hop = whole_milliseconds(configuration.hop_timeout);
  plan.limits.enable = whole_milliseconds(configuration.enable_timeout);
  plan.limits.stop = whole_milliseconds(configuration.stop_timeout);
  plan.limits.fault_resets = configuration.fault_resets;
  return open(plan);
}

}  // namespace flexrf
