#pragma once

#include "motion/jerk_profile.hpp"
#include "motion/kinematics.hpp"

namespace flexrf {

struct JointSample {
  JointVector position = JointVector::Zero();      // rad or m
  JointVector velocity = JointVector::Zero();      // per s
  JointVector acceleration = JointVector::Zero();  // per s^2
};

// A motion of all joints from rest to rest along the straight line between two postures.
//
// One profile of constant-jerk pieces runs along that line, so the joints start and arrive together, at least
// one of them is always at one of its limits, and every posture on the way is within the joints' ranges, for
// the line between two such postures is. A stop brakes along the same line.
//
// Joint space, not a straight line of the tool: every posture on the way exists, and no singularity on the
// way asks for infinite joint rates. Allocates nothing.
class JointTrajectory {
 public:
  // Plans from `start` to `target` (rad, or m where a joint slides). `speed` in (0, 1] scales the chain's
  // limits of velocity, acceleration and jerk. False, and at rest at `start`, when a number is not finite or
  // a limit is not above 0.
  [[nodiscard]] bool plan(const KinematicChain& chain, const JointVector& start, const JointVector& target,
                          double speed = 1.0);

  // From `time` (s) on comes to rest within the limits, on the line, at or before the target.
  void stop(double time);

  // When the motion has come to rest, in s from its start.
  double end_time() const { return profile_start_ + profile_.duration(); }

  // The set-points `time` s after the start: continuous up to the acceleration; from end_time() on, exactly
  // the target (or where the stop ended), at rest.
  JointSample at(double time) const;

 private:
  JointVector start_ = JointVector::Zero();
  JointVector target_ = JointVector::Zero();
  MotionLimits limits_{};  // of the path coordinate, which runs from 0 to 1
  JerkProfile profile_{};
  double profile_start_ = 0;
  bool stopped_ = false;
};

}  // namespace flexrf
