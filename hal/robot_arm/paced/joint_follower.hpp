// JointFollower: from what an arm is commanded to the set-points that its controller takes, one each cycle.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "motion/kinematic_chain.hpp"
#include "motion/set_point_follower.hpp"
#include "runtime/unit/restraint.hpp"

namespace flexrf {

/// In rad, or m where a joint slides; from the base to the tool; 0 beyond the last joint.
using JointAngles = std::array<double, max_joints>;

/// A SetPointFollower for each joint, with the limits of its chain. One thread; never blocks, never
/// allocates.
class JointFollower {
 public:
  /// `cycle`: of the controller, in s. The chain outlives the follower.
  void begin(const KinematicChain& chain, double cycle) noexcept;

  /// At rest here, and nothing else is wanted.
  void seed(const JointAngles& at) noexcept;
  /// Finite. Without effect while it brakes.
  void command(const JointAngles& wanted) noexcept;
  /// Comes to rest, and stays there until it is seeded.
  void brake() noexcept;
  /// The controller may have missed a cycle, in which its joints stood still: from now on they begin at rest.
  void stand() noexcept;

  /// One cycle further.
  const JointAngles& next() noexcept;
  const JointAngles& set_point() const noexcept { return set_point_; }
  /// The first joint that is farther behind what is commanded than it goes in some cycles at its greatest
  /// velocity: what a packet that was lost makes is less.
  Restraint restraint() const noexcept;
  bool brakes() const noexcept { return brakes_; }
  bool is_at_rest() const noexcept;

 private:
  std::span<SetPointFollower> joints() noexcept { return std::span(joints_).first(chain_->joint_count); }

  const KinematicChain* chain_ = nullptr;
  double cycle_ = 0.007;
  bool brakes_ = false;
  std::array<SetPointFollower, max_joints> joints_{};
  JointAngles set_point_{};
};

}  // namespace flexrf
