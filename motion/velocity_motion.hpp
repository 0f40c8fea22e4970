// VelocityMotion: a frame that takes up a velocity, which may become another one at any time.
#pragma once

#include <Eigen/Geometry>

#include "motion/stream_limits.hpp"

namespace flexrf {

// How fast a frame is wanted to move and to turn, in the base frame.
struct ToolVelocity {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();   // m/s, of the frame's origin
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();  // rad/s

  bool is_zero() const { return linear.isZero(0) && angular.isZero(0); }
};

// One vector of velocity. It is led along straight lines (in the space of velocities) by one jerk-limited
// profile at a time, whose acceleration and jerk lie along the line: so their magnitudes are the profile's,
// and between two velocities within the limit there are only such. Where another velocity is wanted that is
// not on the line, the acceleration is first taken off, and then a new line begins. At rest, it moves off
// straight.
class LineMotion {
 public:
  bool is_at_rest() const { return velocity_.isZero(0) && acceleration_ == 0; }
  // Moves on by `time` s towards the velocity `wanted`, no greater than the limit. Returns the way moved.
  Eigen::Vector3d advance(const Eigen::Vector3d& wanted, const MotionLimits& limits, double time);
  // At most so many s until it rests.
  double braking_time(const MotionLimits& limits) const;
  void halt();

  const Eigen::Vector3d& velocity() const { return velocity_; }
  Eigen::Vector3d acceleration() const { return acceleration_ * line_; }

 private:
  double goal_on_line(const Eigen::Vector3d& wanted, const MotionLimits& limits) const;

  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d line_ = Eigen::Vector3d::UnitX();
  double acceleration_ = 0;  // along the line
};

// Position and orientation, each a LineMotion. Plain value; nothing allocates.
class VelocityMotion {
 public:
  void set_limits(const StreamLimits& limits) { limits_ = limits; }
  // At rest here.
  void place(const Eigen::Isometry3d& pose);

  // Moves on by `time` s towards `wanted` (finite). Linear and angular velocities beyond their limits are
  // shortened to them.
  void advance(const ToolVelocity& wanted, double time);
  void brake(double time) { advance({}, time); }
  double braking_time() const;
  // At rest at once, beyond all limits.
  void halt();

  bool is_at_rest() const { return linear_.is_at_rest() && angular_.is_at_rest(); }
  Eigen::Isometry3d pose() const;
  const Eigen::Vector3d& velocity() const { return linear_.velocity(); }           // m/s
  const Eigen::Vector3d& angular_velocity() const { return angular_.velocity(); }  // rad/s

 private:
  StreamLimits limits_{};
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation_ = Eigen::Quaterniond::Identity();
  LineMotion linear_;
  LineMotion angular_;
};

}  // namespace flexrf
