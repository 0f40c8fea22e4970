// What a hand asks of an arm in a cycle: by arrows of the unit's own, and by what its inputs say.
#pragma once

#include <optional>

#include "motion/kinematics.hpp"
#include "motion/velocity_motion.hpp"
#include "robot_control_unit.hpp"

namespace flexrf::user {

struct JogWish {
  ToolVelocity tool;                         // in the base frame
  JointVector joints = JointVector::Zero();  // rad/s or m/s

  bool of_tool() const noexcept { return !tool.is_zero(); }
  bool of_joints() const noexcept { return !joints.isZero(0); }
};

// Held arrows alone. A joint that the chain does not have is left at 0.
JogWish held_arrows(const RobotControlRuntime& runtime, const KinematicChain& chain) noexcept;

// Whether an arrow is held of a joint that the chain does not have.
bool asks_for_missing_joint(const RobotControlRuntime& runtime, const KinematicChain& chain) noexcept;

// A step whose button was pressed since the cycle before.
struct StepWish {
  int axis = 0;    // 0 to 2: along x, y, z; 3 to 5: about them; from 6 on: joints from 0
  double way = 0;  // m or rad, with its sign

  bool of_joint() const noexcept { return axis >= 6; }
  std::size_t joint() const noexcept { return static_cast<std::size_t>(axis - 6); }
};

// The first one of those pressed; none: none was.
std::optional<StepWish> pressed_step(const RobotControlRuntime& runtime) noexcept;

}  // namespace flexrf::user
