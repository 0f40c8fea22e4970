// What every driver of RobotArm must do. A driver's test makes a world, which is the driver and its far end,
// and runs the cases in it.
#pragma once

#include <memory>

#include "hal/robot_arm/interface/robot_arm.hpp"
#include "motion/kinematics.hpp"

namespace flexrf {

class RobotArmWorld {
 public:
  virtual ~RobotArmWorld() = default;

  /// Initialised, at rest, permitted to move.
  virtual RobotArm& arm() = 0;
  /// The thread's cycle: receive, then what the unit does, then send; `elapsed` after the last one.
  virtual void receive(Duration elapsed) = 0;
  virtual void send() = 0;

  /// How far the sensors may be off, in rad.
  virtual double noise() const { return 0; }
  /// The far end no longer tells its positions. False: cannot be made to happen with this driver.
  virtual bool lose_sensors() { return false; }
  /// After lose_sensors(): it tells them again. False: cannot be made to happen with this driver.
  virtual bool find_sensors() { return false; }
  /// A joint stays where it is, whatever is commanded. False: cannot be made to happen with this driver.
  virtual bool stick_joint() { return false; }
  /// The far end's drives trip. False: cannot be made to happen with this driver.
  virtual bool trip_drives() { return false; }
};

/// Commands the arm to its actual position, as the first command has to. Between receive and send of a cycle.
inline void lead_from_here(RobotArm& arm) {
  const auto state = arm.state();
  if (!state) return;
  JointPositions here{};
  here.position_map() = within_limits(arm.kinematic_chain(), state->position_map());
  arm.command(here);
}

using MakeRobotArmWorld = std::unique_ptr<RobotArmWorld> (*)();

/// Runs all cases, each in a world of its own; returns the number that failed, for main().
int run_robot_arm_conformance(const char* driver, MakeRobotArmWorld make);

}  // namespace flexrf
