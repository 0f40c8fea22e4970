// Where an arm's joints put its links and its tool, from the chain as the scene tells it.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <span>

#include "motion/kinematic_chain.hpp"
#include "types/scene_arm.hpp"

namespace flexrf {

SceneArm to_scene_arm(const KinematicChain& chain) noexcept;

/// In the base's frame.
struct ArmFrames {
  std::array<Eigen::Isometry3d, max_joints + 1> links;  ///< the base's, then that behind each joint
  Eigen::Isometry3d tool;
};
/// `positions`: of each joint, rad or m; those that are missing count as 0. The same numbers on every
/// machine.
ArmFrames frames_of(const SceneArm& arm, std::span<const double> positions) noexcept;

}  // namespace flexrf
