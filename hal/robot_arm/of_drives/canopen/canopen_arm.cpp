#include "hal/robot_arm/of_drives/canopen/canopen_arm.hpp"

namespace flexrf {

Status CanopenArm::configure(std::size_t joint, CanopenServoDriveConfiguration& drive) {
  if (configuration.nodes[joint] == 0) {
    return Status::error(StatusCode::invalid_argument, "it has no node: name one for each joint in 'nodes'");
  }
  drive.node = configuration.nodes[joint];
  drive.increments_per_unit = configuration.increments_per_unit[joint];
  drive.homing_method = configuration.homing_methods[joint];
  drive.homing_speed = configuration.homing_speed[joint];
  drive.homing_creep_speed = configuration.homing_creep_speed[joint];
  drive.rest_velocity = configuration.rest_velocity[joint];
  drive.quick_stop_deceleration = configuration.quick_stop_deceleration[joint];
  return {};
}

}  // namespace flexrf
