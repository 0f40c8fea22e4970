// What the tables of all drivers that lead an axis of CiA 402 call alike.
#pragma once

#include "hal/canopen/axis_on_bus.hpp"

namespace flexrf::canopen {

/// `Columns`: a driver's generated configuration. What its interface says of the motion is not among them: of
/// that each interface has its own.
template <class Columns>
void read_axis_columns(const Columns& columns, cia402::AxisPlan& plan) noexcept {
  plan.node = columns.node;
  plan.master = columns.master;
  plan.vendor = columns.vendor;
  plan.product = columns.product;
  plan.period = whole_milliseconds(columns.period);
  plan.increments_per_unit = columns.increments_per_unit;
  plan.velocity_factor = columns.velocity_factor;
  plan.acceleration_factor = columns.acceleration_factor;
  plan.quick_stop_deceleration = columns.quick_stop_deceleration;
  plan.quick_stop_option = columns.quick_stop_option;
  plan.rest_velocity = columns.rest_velocity;
  plan.homing_creep_speed = columns.homing_creep_speed;
  plan.homing_settle = whole_milliseconds(columns.homing_settle);
  plan.homing_tells_reached = columns.homing_tells_reached;
  plan.abort_connection = columns.abort_connection;
  plan.tells_abort_connection = columns.tells_abort_connection;
  plan.tells_period = columns.tells_period;
  plan.is_supervised_by_it = columns.supervises_us;
  plan.forbids_remote = columns.forbids_remote;
  plan.is_guarded = columns.guarded;
  plan.changes_mode_enabled = columns.changes_mode_enabled;
  plan.changes_target_at_once = columns.changes_target_at_once;
  plan.maps_mode = columns.maps_mode;
  plan.maps_speed = columns.maps_speed;
  plan.maps_velocity = columns.maps_velocity;
  plan.tells_speed = columns.tells_speed;
  plan.mode_timeout = whole_milliseconds(columns.mode_timeout);
  plan.set_point_timeout = whole_milliseconds(columns.set_point_timeout);
  plan.boot_timeout = whole_milliseconds(columns.boot_timeout);
  plan.sdo_timeout = whole_milliseconds(columns.sdo_timeout);
  plan.heartbeat_period = whole_milliseconds(columns.heartbeat_period);
  plan.heartbeat_limit = whole_milliseconds(columns.heartbeat_limit);
  plan.limits.hop = whole_milliseconds(columns.hop_timeout);
  plan.limits.enable = whole_milliseconds(columns.enable_timeout);
  plan.limits.stop = whole_milliseconds(columns.stop_timeout);
  plan.limits.fault_resets = columns.fault_resets;
}

}  // namespace flexrf::canopen
