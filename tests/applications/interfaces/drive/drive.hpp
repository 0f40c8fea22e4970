#pragma once

#include "drive_interface.hpp"
#include "hal/driver/actuator.hpp"

namespace flexrf::user {

class Drive : public Actuator<DriveInterface> {
 public:
  /// Part of its highest speed that it shall reach, 0 to 1.
  void command(double speed) noexcept {
    if (may_act()) follow(speed);
  }
  virtual double speed() const noexcept = 0;

 private:
  virtual void follow(double speed) noexcept = 0;
};

}  // namespace flexrf::user
