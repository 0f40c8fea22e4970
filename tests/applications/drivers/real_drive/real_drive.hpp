#pragma once

#include "real_drive_driver.hpp"

namespace flexrf::user {

class RealDrive final : public RealDriveDriver {
 public:
  void command(double /*speed*/) noexcept override {}
  double speed() const noexcept override { return 0; }
};

}  // namespace flexrf::user
