#pragma once

#include "simulated_axle_driver.hpp"

namespace flexrf::user {

class SimulatedAxle final : public SimulatedAxleDriver {
 public:
  Status initialise() override {
    speed_ = 0;
    return {};
  }
  void command(double speed) noexcept override { commanded_ = speed; }
  double speed() const noexcept override { return speed_; }
  void send(const Tick& /*tick*/) noexcept override {
    speed_ = is_inhibited() ? 0 : commanded_;
    feedback.speed = speed_;
    feedback.temperature = configuration.warmth + speed_;
  }
  bool make_safe() noexcept override {
    speed_ = 0;
    return true;
  }

 private:
  double commanded_ = 0;
  double speed_ = 0;
};

}  // namespace flexrf::user
