#include "hal/servo_drive/canopen/canopen_servo_drive.hpp"

#include "hal/canopen/axis_columns.hpp"

namespace flexrf {

Status CanopenServoDrive::initialise() {
  canopen::cia402::AxisPlan plan = plan_from_interface();
  canopen::read_axis_columns(configuration, plan);
  if (configuration.interpolates) {
    if (configuration.mode != ServoMode::cyclic_position)
      return Status::error(StatusCode::invalid_argument,
                           "configuration: `interpolates` is of mode cyclic_position alone");
    plan.mode = canopen::cia402::Mode::interpolated_position;
  }
  return open(plan);
}

}  // namespace flexrf
