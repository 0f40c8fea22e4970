// PoseMotion: a frame that moves to rest at a pose, which may become another one at any time.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>

#include "motion/stream_limits.hpp"

namespace flexrf {

// One vector (a position, or an orientation as a rotation vector from where it is) on three axes, each of
// which is led by towards_position(). An axis has a part of the vector's limits, and the squares of the parts
// add up to 1: so no vector's magnitude exceeds the limit, whatever the axes do. The first axis, which has
// 4/5, is laid towards the goal while the vector rests: from rest to a goal that stays, the way is straight.
class AxesMotion {
 public:
  bool is_at_rest() const;
  // Moves on by `time` s towards `goal`, as seen from here in the base frame, at no more than `part` (0 to 1)
  // of the limit of velocity. Returns the way moved, in the base frame.
  Eigen::Vector3d advance(const Eigen::Vector3d& goal, const MotionLimits& limits, double part, double time);
  // Likewise, to rest as fast as the limits allow.
  Eigen::Vector3d brake(const MotionLimits& limits, double time);
  // s until that rests.
  double braking_time(const MotionLimits& limits) const;
  // The way from here to where that rests, in the base frame.
  Eigen::Vector3d way_to_rest(const MotionLimits& limits) const;
  void halt();

  // In the base frame, per s and per s^2.
  Eigen::Vector3d velocity() const;
  Eigen::Vector3d acceleration() const;
  // Of the first axis, in the base frame.
  Eigen::Vector3d direction() const { return frame_.col(0); }
  // The part (0 to 1) of the limits that the magnitude of a motion along the unit vector `other` may take
  // beside this one, so that both together keep to them, whatever they do.
  double room_beside(const Eigen::Vector3d& other) const;

 private:
  Eigen::Matrix3d frame_ = Eigen::Matrix3d::Identity();  // columns: the axes in the base frame
  std::array<MotionState, 3> axes_{};                    // positions are 0: from here
};

// Position and orientation, each an AxesMotion. An orientation's way is a turn about one axis where it begins
// at rest and its goal stays. Plain value; nothing allocates.
//
// A position can be led on to another goal in two ways. Where the goal just changes it bows, by as much as
// the change is far. Where it turns off it comes to rest on the straight way that it is on, and moves from
// there along the straight way to the new goal meanwhile: it is the sum of both motions, so within the
// triangle of where it turned off, where it would have come to rest, and the new goal.
class PoseMotion {
 public:
  void set_limits(const StreamLimits& limits) { limits_ = limits; }
  // At rest here.
  void place(const Eigen::Isometry3d& pose);

  // What advance() leads to from now on begins another straight way. False, and nothing changed: the way that
  // it turned off last is still being left.
  bool turn_off();
  // Moves on by `time` s towards `target` (finite), at no more than `part` of the limits of velocity. While a
  // way is being left the new one leads to the first target, or where that is not nearly the same any more,
  // to rest.
  void advance(const Eigen::Isometry3d& target, double part, double time);
  void brake(double time);
  double braking_time() const;
  // At rest at once, beyond all limits.
  void halt();

  bool is_at_rest() const { return linear_.is_at_rest() && left_.is_at_rest() && angular_.is_at_rest(); }
  Eigen::Isometry3d pose() const;
  Eigen::Vector3d velocity() const { return linear_.velocity() + left_.velocity(); }  // m/s
  Eigen::Vector3d angular_velocity() const { return angular_.velocity(); }            // rad/s

 private:
  void move(const Eigen::Vector3d& way, const Eigen::Vector3d& turn);
  Eigen::Vector3d leave(double time);
  MotionLimits limits_beside(const Eigen::Vector3d& way) const;

  StreamLimits limits_{};
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation_ = Eigen::Quaterniond::Identity();
  AxesMotion linear_;
  AxesMotion angular_;
  AxesMotion left_;                                      // the way that it turned off: it comes to rest
  Eigen::Vector3d left_rest_ = Eigen::Vector3d::Zero();  // m, from here to there
  std::optional<Eigen::Vector3d> beside_;                // the new goal meanwhile
};

// The rotation as a vector along its axis, as long as its angle (0 to pi rad); and back.
Eigen::Vector3d rotation_vector(const Eigen::Quaterniond& rotation);
Eigen::Quaterniond rotation_about(const Eigen::Vector3d& vector);

}  // namespace flexrf
