#pragma once

#include "real_drive_driver.hpp"

namespace flexrf::user {

class RealDrive final : public RealDriveDriver {
 public:
  double speed() const noexcept override { return 0; }

 private:
  void follow(double /*speed*/) noexcept override {}
  void forget() noexcept override {}
  void act(const Tick& /*tick*/) noexcept override {}
  void rest(const Tick& /*tick*/) noexcept override {}
  bool become_safe() noexcept override { return true; }
};

}  // namespace flexrf::user
