// SimulatedGripper: a Robotiq two-finger gripper, led as a real one is, whose far end is a model.
#pragma once

#include <memory>

#include "hal/gripper/robotiq/robotiq_driver.hpp"
#include "hal/gripper/robotiq/simulator/robotiq_model.hpp"
#include "simulated_gripper_driver.hpp"

namespace flexrf {

class SimulatedGripper final : public robotiq::RobotiqDriver<SimulatedGripperDriver> {
 public:
  Status initialise() override;

  /// For tests, from initialise() on: what the fingers meet, and what goes wrong. Any thread.
  robotiq::RobotiqModel& model() noexcept { return *model_; }

 protected:
  void hear(const Tick& tick) noexcept override;

 private:
  std::shared_ptr<robotiq::RobotiqModel> model_;  // the link's, too: its thread may be in a request
};

}  // namespace flexrf
