// SimulatedArm: an arm that is a model of its servos, limits and sensors, and can be given faults.
#pragma once

#include <random>

#include "hal/robot_arm/interface/robot_arm.hpp"
#include "hal/robot_arm/simulated/arm_model.hpp"
#include "simulated_arm_driver.hpp"

namespace flexrf {

class SimulatedArm final : public SimulatedArmDriver {
 public:
  enum class Fault : std::uint8_t {
    drives_trip,   ///< the arm brakes, holds and reports a device fault
    sensors_lost,  ///< state() is empty from now on
    joint_sticks,  ///< the first joint stays where it is
  };

  Status initialise() override;

  std::optional<JointState> state() const noexcept override { return state_; }
  Time measured_at() const noexcept override { return state_ ? measured_at_ : Time{}; }

  /// For tests: as the configuration's faults, at the next cycle.
  void inject(Fault fault) noexcept;

 private:
  void take_in(const Tick& tick) noexcept override;
  void forget() noexcept override;
  void act(const Tick& tick) noexcept override;
  void rest(const Tick& /*tick*/) noexcept override {}
  bool become_safe() noexcept override;
  void follow(const JointPositions& set_points) noexcept override;

  void inject_scheduled(Time now) noexcept;
  void sense(Time now) noexcept;

  ArmModel model_;
  std::optional<JointState> state_;
  Time measured_at_{};
  std::optional<JointPositions> commanded_;
  std::mt19937_64 random_;
  std::normal_distribution<double> noise_;
  Time started_{};
  bool sensors_lost_ = false;
};

}  // namespace flexrf
