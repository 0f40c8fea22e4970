#include "hal/linux/canopen_arm/canopen_arm.hpp"

namespace flexrf {

Status CanopenArm::configure(std::size_t joint, CanopenServoDriveConfiguration& drive) {
  if (configuration.nodes[joint] == 0) {
    return Status::error(StatusCode::invalid_argument, "it has no node: name one for each joint in 'nodes'");
  }
  drive.node = configuration.nodes[joint];
  drive.increments_per_unit = configuration.increments_per_unit[joint];
  drive.homing_method = configuration.homing_methods[joint];
  drive.homing_speed = configuration.homing_speed;
  drive.master = configuration.master;
  drive.vendor = configuration.vendor;
  drive.product = configuration.product;
  drive.period = configuration.period;
  drive.rest_velocity = configuration.rest_velocity;
  drive.quick_stop_deceleration = configuration.quick_stop_deceleration;
  drive.abort_connection = configuration.abort_connection;
  drive.boot_timeout = configuration.boot_timeout;
  drive.heartbeat_period = configuration.heartbeat_period;
  drive.heartbeat_limit = configuration.heartbeat_limit;
  drive.enable_timeout = configuration.enable_timeout;
  drive.stop_timeout = configuration.stop_timeout;
  return {};
}

}  // namespace flexrf
