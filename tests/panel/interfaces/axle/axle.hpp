#pragma once

#include "axle_interface.hpp"
#include "hal/driver/actuator.hpp"

namespace flexrf::user {

class Axle : public Actuator<AxleInterface> {
 public:
  /// rad/s
  void command(double speed) noexcept {
    if (may_act()) follow(speed);
  }
  virtual double speed() const noexcept = 0;  ///< rad/s

 private:
  virtual void follow(double speed) noexcept = 0;
};

}  // namespace flexrf::user
