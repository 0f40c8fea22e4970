#pragma once

#include "base/status.hpp"
#include "motion/joint_trajectory.hpp"
#include "types/pose.hpp"

namespace flexrf {

/// Moves an arm to poses of its tool, one motion after the other: set-points for every cycle, limited in
/// velocity, acceleration and jerk. Belongs to one thread; allocates nothing. The longest call, move_to(),
/// takes a few hundred microseconds.
class ArmMotion {
 public:
  /// Before anything else. The chain outlives this.
  void use(const KinematicChain& chain) noexcept;

  /// At rest at these joint positions (rad or m, finite), whatever was before: set-points begin where the arm
  /// is.
  void seed(const JointVector& actual) noexcept;
  bool is_seeded() const noexcept { return seeded_; }

  /// Begins a motion from the present set-point, which is at rest, to the tool's pose `target`. `speed` in
  /// (0, 1] scales the arm's limits. Refused, with the reason, when the pose cannot be reached from here; the
  /// arm then stays where it is.
  Status move_to(const Pose& target, double speed) noexcept;

  /// Comes to rest on the path, within the limits.
  void stop() noexcept;

  bool is_moving() const noexcept { return moving_; }

  /// Moves the set-point on by `elapsed` s.
  void advance(double elapsed) noexcept;

  /// Joint positions to command now, in rad, or m where a joint slides.
  const JointVector& set_point() const noexcept { return set_point_; }

 private:
  const KinematicChain* chain_ = nullptr;
  JointTrajectory trajectory_;
  JointVector set_point_ = JointVector::Zero();
  double time_ = 0;  // s, in the trajectory
  bool seeded_ = false;
  bool moving_ = false;
};

}  // namespace flexrf
