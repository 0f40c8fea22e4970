#pragma once

#include "drive_interface.hpp"

namespace flexrf::user {

class Drive : public DriveInterface {
 public:
  /// Part of its highest speed that it shall reach, 0 to 1.
  virtual void command(double speed) noexcept = 0;
  virtual double speed() const noexcept = 0;
};

}  // namespace flexrf::user
