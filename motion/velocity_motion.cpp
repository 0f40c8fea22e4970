#include "motion/velocity_motion.hpp"

#include <algorithm>
#include <cmath>

#include "motion/jerk_profile.hpp"
#include "motion/pose_motion.hpp"

namespace flexrf {
namespace {

// Less is no change of velocity.
constexpr double no_change = 1e-12;  // m/s or rad/s
// So far beside the line, as a part of the limit, a velocity counts as one on it.
constexpr double beside = 0.02;
constexpr double rounding = 1e-12;
// Lines in one call: the one that is left, the one that is taken, and one for what lay beside it.
constexpr int most_lines = 4;

Eigen::Vector3d no_longer_than(const Eigen::Vector3d& vector, double most) {
  const double length = vector.norm();
  return length > most ? Eigen::Vector3d(vector * (most / length)) : vector;
}

}  // namespace

// How much the velocity is to change along the line.
double LineMotion::goal_on_line(const Eigen::Vector3d& wanted, const MotionLimits& limits) const {
  // What it changes by until the acceleration is taken off.
  const double coasting = acceleration_ * std::abs(acceleration_) / (2 * limits.jerk);
  const Eigen::Vector3d rest = wanted - velocity_ - coasting * line_;
  const double along = line_.dot(rest);
  // This does not change on the line: however often one asks, the way is the same.
  if ((rest - along * line_).norm() > beside * limits.velocity) return coasting;
  // The foot of the perpendicular from a velocity within the limit may lie beyond it, and not by rounding.
  const double change = coasting + along;
  return (velocity_ + change * line_).norm() <= limits.velocity * (1 + rounding) ? change : coasting;
}

Eigen::Vector3d LineMotion::advance(const Eigen::Vector3d& wanted, const MotionLimits& limits, double time) {
  Eigen::Vector3d way = Eigen::Vector3d::Zero();
  double left = time;
  for (int lines = 0; lines < most_lines && left > 0; ++lines) {
    if (acceleration_ == 0) {
      const Eigen::Vector3d change = wanted - velocity_;
      const double size = change.norm();
      if (size < no_change) {
        velocity_ = wanted;
        break;
      }
      line_ = change / size;
    }
    const double change = acceleration_ == 0 ? line_.dot(wanted - velocity_) : goal_on_line(wanted, limits);
    // Seen from a frame that moves with the goal, it is a stop.
    const JerkProfile stop =
        JerkProfile::stop({.position = 0, .velocity = -change, .acceleration = acceleration_}, limits);
    const double lasts = std::min(left, stop.duration());
    const MotionState seen = stop.at(lasts);
    way += velocity_ * lasts + (change * lasts + seen.position) * line_;
    velocity_ += (change + seen.velocity) * line_;
    acceleration_ = seen.acceleration;
    left -= lasts;
  }
  return way + velocity_ * left;
}

double LineMotion::braking_time(const MotionLimits& limits) const {
  const double ramp = std::abs(acceleration_) / limits.jerk;
  const double fastest = velocity_.norm() + ramp * std::abs(acceleration_) / 2;
  return ramp + JerkProfile::stop({.position = 0, .velocity = fastest, .acceleration = 0}, limits).duration();
}

void LineMotion::halt() {
  velocity_.setZero();
  acceleration_ = 0;
}

void VelocityMotion::place(const Eigen::Isometry3d& pose) {
  position_ = pose.translation();
  orientation_ = Eigen::Quaterniond(pose.linear()).normalized();
  halt();
}

void VelocityMotion::advance(const ToolVelocity& wanted, double time) {
  position_ += linear_.advance(no_longer_than(wanted.linear, limits_.linear.velocity), limits_.linear, time);
  const Eigen::Vector3d turn =
      angular_.advance(no_longer_than(wanted.angular, limits_.angular.velocity), limits_.angular, time);
  orientation_ = (rotation_about(turn) * orientation_).normalized();
}

double VelocityMotion::braking_time() const {
  return std::max(linear_.braking_time(limits_.linear), angular_.braking_time(limits_.angular));
}

void VelocityMotion::halt() {
  linear_.halt();
  angular_.halt();
}

Eigen::Isometry3d VelocityMotion::pose() const {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = orientation_.toRotationMatrix();
  pose.translation() = position_;
  return pose;
}

}  // namespace flexrf
