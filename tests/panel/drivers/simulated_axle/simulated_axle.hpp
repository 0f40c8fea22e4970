#pragma once

#include "simulated_axle_driver.hpp"

namespace flexrf::user {

class SimulatedAxle final : public SimulatedAxleDriver {
 public:
  Status initialise() override {
    speed_ = 0;
    return {};
  }
  double speed() const noexcept override { return speed_; }

 private:
  void follow(double speed) noexcept override { commanded_ = speed; }
  void forget() noexcept override { commanded_ = 0; }
  void act(const Tick& /*tick*/) noexcept override { turn(commanded_); }
  void rest(const Tick& /*tick*/) noexcept override { turn(0); }
  bool become_safe() noexcept override {
    turn(0);
    return true;
  }
  void turn(double speed) noexcept {
    speed_ = speed;
    feedback.speed = speed_;
    feedback.temperature = configuration.warmth + speed_;
  }

  double commanded_ = 0;
  double speed_ = 0;
};

}  // namespace flexrf::user
