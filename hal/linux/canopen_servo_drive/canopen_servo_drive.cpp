#include "hal/linux/canopen_servo_drive/canopen_servo_drive.hpp"

#include "hal/canopen/axis_columns.hpp"

namespace flexrf {

Status CanopenServoDrive::initialise() {
  canopen::cia402::AxisPlan plan = plan_from_interface();
  canopen::read_axis_columns(configuration, plan);
  return open(plan);
}

}  // namespace flexrf
