#include "hal/linux/canopen_gripper/canopen_gripper.hpp"

namespace flexrf {

Status CanopenGripper::initialise() {
  using canopen::whole_milliseconds;
  canopen::GripperAxisPlan plan = plan_from_interface();
  plan.opening_at_zero = configuration.opening_at_zero;
  plan.weakest = configuration.weakest;
  plan.strongest = configuration.strongest;
  plan.rated_force = configuration.rated_force;
  plan.grip_share = configuration.grip_share;
  plan.grip_time = whole_milliseconds(configuration.grip_time);
  plan.slip = configuration.slip;

  canopen::cia402::AxisPlan axis;
  axis.node = configuration.node;
  axis.master = configuration.master;
  axis.vendor = configuration.vendor;
  axis.product = configuration.product;
  axis.period = whole_milliseconds(configuration.period);
  axis.increments_per_unit = configuration.increments_per_unit;
  axis.fastest = configuration.fastest;
  axis.acceleration = configuration.acceleration;
  axis.velocity_factor = configuration.velocity_factor;
  axis.acceleration_factor = configuration.acceleration_factor;
  axis.quick_stop_deceleration = configuration.quick_stop_deceleration;
  axis.rest_velocity = configuration.rest_velocity;
  axis.homing_method = configuration.homing_method;
  axis.homing_speed = configuration.homing_speed;
  axis.homing_creep_speed = configuration.homing_creep_speed;
  axis.homing_settle = whole_milliseconds(configuration.homing_settle);
  axis.homing_timeout = whole_milliseconds(configuration.activation_timeout);
  axis.limits_torque = configuration.limits_torque;
  axis.tells_torque = configuration.tells_torque;
  axis.may_be_blocked = configuration.ignores_following_error;
  axis.abort_connection = configuration.abort_connection;
  axis.tells_abort_connection = configuration.tells_abort_connection;
  axis.tells_period = configuration.tells_period;
  axis.is_supervised_by_it = configuration.supervises_us;
  axis.forbids_remote = configuration.forbids_remote;
  axis.mode_timeout = whole_milliseconds(configuration.mode_timeout);
  axis.set_point_timeout = whole_milliseconds(configuration.set_point_timeout);
  axis.boot_timeout = whole_milliseconds(configuration.boot_timeout);
  axis.sdo_timeout = whole_milliseconds(configuration.sdo_timeout);
  axis.heartbeat_period = whole_milliseconds(configuration.heartbeat_period);
  axis.heartbeat_limit = whole_milliseconds(configuration.heartbeat_limit);
  axis.limits.hop = whole_milliseconds(configuration.hop_timeout);
  axis.limits.enable = whole_milliseconds(configuration.enable_timeout);
  axis.limits.stop = whole_milliseconds(configuration.stop_timeout);
  axis.limits.fault_resets = configuration.fault_resets;
  return open(plan, axis);
}

}  // namespace flexrf
