// CanopenGripper: fingers that an axis of a CiA 402 drive moves.
#pragma once

#include "canopen_gripper_driver.hpp"
#include "hal/gripper/canopen/axis_gripper.hpp"

namespace flexrf {

class CanopenGripper final : public AxisGripper<CanopenGripperDriver> {
 public:
  Status initialise() override;
};

}  // namespace flexrf
