#include "hal/robot_arm/of_drives/simulated/simulated_drive_arm.hpp"

namespace flexrf {

Status SimulatedDriveArm::configure(std::size_t joint, SimulatedServoDriveConfiguration& drive) {
  if (configuration.nodes[joint] == 0) {
    return Status::error(StatusCode::invalid_argument, "it has no node: name one for each joint in 'nodes'");
  }
  drive.node = configuration.nodes[joint];
  drive.increments_per_unit = configuration.increments_per_unit[joint];
  drive.homing_method = configuration.homing_methods[joint];
  drive.homing_speed = configuration.homing_speed[joint];
  drive.first_position = chain->joints[joint].home;
  return {};
}

}  // namespace flexrf
