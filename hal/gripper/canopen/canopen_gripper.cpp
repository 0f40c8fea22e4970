#include "hal/gripper/canopen/canopen_gripper.hpp"

#include "hal/canopen/axis_columns.hpp"

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
  canopen::read_axis_columns(configuration, axis);
  axis.fastest = configuration.fastest;
  axis.acceleration = configuration.acceleration;
  axis.homing_method = configuration.homing_method;
  axis.homing_speed = configuration.homing_speed;
  axis.homing_timeout = whole_milliseconds(configuration.activation_timeout);
  axis.limits_torque = configuration.limits_torque;
  axis.tells_torque = configuration.tells_torque;
  axis.may_be_blocked = configuration.ignores_following_error;
  return open(plan, axis);
}

}  // namespace flexrf
