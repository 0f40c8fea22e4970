#include "motion/pose_motion.hpp"

#include <algorithm>
#include <cmath>

#include "motion/axis_motion.hpp"

namespace flexrf {
namespace {

// Parts of a vector's limits that its axes have.
constexpr double along_share = 0.8;
constexpr double across_share = 0.42426406871192851;  // 0.6 / sqrt(2)
// Too short a way to have a direction.
constexpr double no_way = 1e-9;  // m or rad

MotionLimits part_of(const MotionLimits& limits, std::size_t axis) {
  const double part = axis == 0 ? along_share : across_share;
  return {part * limits.velocity, part * limits.acceleration, part * limits.jerk};
}

/// A rotation whose first axis points along `way`: the smallest one, as Quaterniond::FromTwoVectors() gives
/// it. Near straight back that loses digits and takes an SVD, which takes longer to compile than all else of
/// this file: there it is the frame of the way forth, turned by half.
Eigen::Matrix3d frame_along(const Eigen::Vector3d& way) {
  const Eigen::Vector3d direction = way.normalized();
  const double cosine = direction.x();
  if (cosine < -0.999) return frame_along(-way) * Eigen::Vector3d(-1, -1, 1).asDiagonal();
  const double twice = std::sqrt((1 + cosine) * 2);
  const Eigen::Vector3d axis = Eigen::Vector3d::UnitX().cross(direction) * (1 / twice);
  return Eigen::Quaterniond(twice * 0.5, axis.x(), axis.y(), axis.z()).toRotationMatrix();
}

}  // namespace

bool AxesMotion::is_at_rest() const {
  return std::all_of(axes_.begin(), axes_.end(),
                     [](const MotionState& axis) { return axis.velocity == 0 && axis.acceleration == 0; });
}

Eigen::Vector3d AxesMotion::advance(const Eigen::Vector3d& goal, const MotionLimits& limits, double part,
                                    double time) {
  const double distance = goal.norm();
  if (is_at_rest() && distance > no_way) {
    frame_ = frame_along(goal);
  }
  const Eigen::Vector3d seen = frame_.transpose() * goal;
  Eigen::Vector3d way;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    MotionLimits own = part_of(limits, i);
    own.velocity *= part;
    const auto index = static_cast<Eigen::Index>(i);
    MotionState next = towards_position(axes_[i], seen[index], own, time);
    way[index] = next.position;
    next.position = 0;
    axes_[i] = next;
  }
  return frame_ * way;
}

Eigen::Vector3d AxesMotion::brake(const MotionLimits& limits, double time) {
  Eigen::Vector3d way;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    MotionState next = JerkProfile::stop(axes_[i], part_of(limits, i)).at(time);
    way[static_cast<Eigen::Index>(i)] = next.position;
    next.position = 0;
    axes_[i] = next;
  }
  return frame_ * way;
}

double AxesMotion::braking_time(const MotionLimits& limits) const {
  double longest = 0;
  for (std::size_t i = 0; i < axes_.size(); ++i)
    longest = std::max(longest, JerkProfile::stop(axes_[i], part_of(limits, i)).duration());
  return longest;
}

void AxesMotion::halt() {
  axes_ = {};
}

Eigen::Vector3d AxesMotion::velocity() const {
  return frame_ * Eigen::Vector3d(axes_[0].velocity, axes_[1].velocity, axes_[2].velocity);
}

Eigen::Vector3d AxesMotion::acceleration() const {
  return frame_ * Eigen::Vector3d(axes_[0].acceleration, axes_[1].acceleration, axes_[2].acceleration);
}

void PoseMotion::place(const Eigen::Isometry3d& pose) {
  position_ = pose.translation();
  orientation_ = Eigen::Quaterniond(pose.linear()).normalized();
  linear_ = {};
  angular_ = {};
}

void PoseMotion::advance(const Eigen::Isometry3d& target, double part, double time) {
  const Eigen::Quaterniond wanted(target.linear());
  const Eigen::Vector3d turn = rotation_vector(wanted * orientation_.conjugate());
  const Eigen::Vector3d way = linear_.advance(target.translation() - position_, limits_.linear, part, time);
  move(way, angular_.advance(turn, limits_.angular, part, time));
}

void PoseMotion::brake(double time) {
  const Eigen::Vector3d way = linear_.brake(limits_.linear, time);
  move(way, angular_.brake(limits_.angular, time));
}

double PoseMotion::braking_time() const {
  return std::max(linear_.braking_time(limits_.linear), angular_.braking_time(limits_.angular));
}

void PoseMotion::halt() {
  linear_.halt();
  angular_.halt();
}

Eigen::Isometry3d PoseMotion::pose() const {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = orientation_.toRotationMatrix();
  pose.translation() = position_;
  return pose;
}

// In a cycle the axes of a turn count as those where it begins, so a turn that changes its axis is off by
// about time^2 |w x a| / 4 in its velocity: for 1 rad/s, 10 rad/s^2 and 7 ms 0.1 mrad/s.
void PoseMotion::move(const Eigen::Vector3d& way, const Eigen::Vector3d& turn) {
  position_ += way;
  if (turn.isZero(0)) return;  // nor does rounding turn it
  orientation_ = (rotation_about(turn) * orientation_).normalized();
}

Eigen::Vector3d rotation_vector(const Eigen::Quaterniond& rotation) {
  // Of the two quaternions of a rotation, the one of the shorter turn.
  const double sign = rotation.w() < 0 ? -1 : 1;
  const Eigen::Vector3d vector = sign * rotation.vec();
  const double sine = vector.norm();
  if (sine < 1e-12) return 2 * vector;
  return 2 * std::atan2(sine, sign * rotation.w()) / sine * vector;
}

Eigen::Quaterniond rotation_about(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  Eigen::Quaterniond rotation;
  rotation.w() = std::cos(angle / 2);
  rotation.vec() =
      angle < 1e-12 ? Eigen::Vector3d(vector / 2) : Eigen::Vector3d(std::sin(angle / 2) / angle * vector);
  return rotation;
}

}  // namespace flexrf
