// CanopenServoDrive: a CiA 402 drive on a CAN bus.
#pragma once

#include "canopen_servo_drive_driver.hpp"
#include "hal/canopen/canopen_drive.hpp"

namespace flexrf {

class CanopenServoDrive final : public CanopenDrive<CanopenServoDriveDriver> {
 public:
  Status initialise() override;
};

}  // namespace flexrf
