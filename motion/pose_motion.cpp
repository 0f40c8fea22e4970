#include "motion/pose_motion.hpp"

#include <algorithm>
#include <cmath>

#include "motion/axis_motion.hpp"

namespace flexrf {
namespace {

// Parts of a vector's limits that its axes have.
constexpr double along_share = 0.8;
constexpr double across_share = 0.42426406871192851;  // 0.6 / sqrt(2)
// Part of the limits: with less than that a new motion waits until the other one has ended.
constexpr double too_little = 0.05;
// A goal that moves by more while a way is being left is another goal.
constexpr double another_goal = 0.005;  // m
// Too short a way to have a direction.
constexpr double no_way = 1e-9;  // m or rad

double share_of(std::size_t axis) {
  return axis == 0 ? along_share : across_share;
}

MotionLimits part_of(const MotionLimits& limits, double part) {
  return {part * limits.velocity, part * limits.acceleration, part * limits.jerk};
}

bool rests(const MotionState& axis) {
  return axis.velocity == 0 && axis.acceleration == 0;
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
  return std::all_of(axes_.begin(), axes_.end(), rests);
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
    MotionLimits own = part_of(limits, share_of(i));
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
    MotionState next = JerkProfile::stop(axes_[i], part_of(limits, share_of(i))).at(time);
    way[static_cast<Eigen::Index>(i)] = next.position;
    next.position = 0;
    axes_[i] = next;
  }
  return frame_ * way;
}

double AxesMotion::braking_time(const MotionLimits& limits) const {
  double longest = 0;
  for (std::size_t i = 0; i < axes_.size(); ++i)
    longest = std::max(longest, JerkProfile::stop(axes_[i], part_of(limits, share_of(i))).duration());
  return longest;
}

Eigen::Vector3d AxesMotion::way_to_rest(const MotionLimits& limits) const {
  Eigen::Vector3d way;
  for (std::size_t i = 0; i < axes_.size(); ++i)
    way[static_cast<Eigen::Index>(i)] = rest_position(axes_[i], part_of(limits, share_of(i)));
  return frame_ * way;
}

double AxesMotion::room_beside(const Eigen::Vector3d& other) const {
  double squares = 0;
  for (std::size_t i = 0; i < axes_.size(); ++i)
    if (!rests(axes_[i])) squares += share_of(i) * share_of(i);
  // A motion along the first axis alone has the direction of that axis; any other may have any direction.
  const bool is_straight = rests(axes_[1]) && rests(axes_[2]);
  const double cosine = is_straight ? std::abs(direction().dot(other)) : 1;
  const double along = std::sqrt(squares) * cosine;
  return std::sqrt(std::max(0.0, along * along + 1 - squares)) - along;
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
  left_ = {};
  left_rest_.setZero();
}

void PoseMotion::turn_off() {
  left_ = linear_;
  left_rest_ = left_.way_to_rest(limits_.linear);
  linear_ = {};
  beside_.reset();
}

// Moves left_ on by `time` s. Returns the way moved, in the base frame.
Eigen::Vector3d PoseMotion::leave(double time) {
  if (left_.is_at_rest()) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d way = left_.brake(limits_.linear, time);
  left_rest_ -= way;
  if (left_.is_at_rest()) left_rest_.setZero();
  return way;
}

// Limits of linear_, which goes along `way` if it has not begun yet. A velocity of 0: it waits for left_.
MotionLimits PoseMotion::limits_beside(const Eigen::Vector3d& way) const {
  if (left_.is_at_rest()) return limits_.linear;
  const double length = way.norm();
  if (linear_.is_at_rest() && length <= no_way) return {};
  const double room =
      left_.room_beside(linear_.is_at_rest() ? Eigen::Vector3d(way / length) : linear_.direction());
  return room < too_little ? MotionLimits{} : part_of(limits_.linear, std::min(1.0, room / along_share));
}

void PoseMotion::advance(const Eigen::Isometry3d& target, std::uint32_t way, double part, double time) {
  if (way != way_) {
    if (!left_.is_at_rest()) return brake(time);
    turn_off();
    way_ = way;
  }
  const Eigen::Quaterniond wanted(target.linear());
  const Eigen::Vector3d turn = rotation_vector(wanted * orientation_.conjugate());
  if (left_.is_at_rest()) {
    beside_.reset();
  } else if (!beside_) {
    beside_ = target.translation();
  }
  const Eigen::Vector3d goal = beside_.value_or(target.translation()) - position_ - left_rest_;
  const bool is_called_off = beside_ && (target.translation() - *beside_).norm() > another_goal;
  const MotionLimits limits = limits_beside(goal);
  Eigen::Vector3d moved = leave(time);
  if (limits.velocity > 0)
    moved += is_called_off ? linear_.brake(limits, time) : linear_.advance(goal, limits, part, time);
  move(moved, angular_.advance(turn, limits_.angular, part, time));
}

void PoseMotion::brake(double time) {
  Eigen::Vector3d way = Eigen::Vector3d::Zero();
  if (!linear_.is_at_rest()) way = linear_.brake(limits_beside(way), time);
  way += leave(time);
  move(way, angular_.brake(limits_.angular, time));
}

double PoseMotion::braking_time() const {
  double longest = std::max(left_.braking_time(limits_.linear), angular_.braking_time(limits_.angular));
  if (!linear_.is_at_rest())
    longest = std::max(longest, linear_.braking_time(limits_beside(Eigen::Vector3d::Zero())));
  return longest;
}

void PoseMotion::halt() {
  linear_.halt();
  left_.halt();
  left_rest_.setZero();
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
