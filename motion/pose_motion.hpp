// PoseMotion: a frame that moves to rest at a pose, which may become another one at any time.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
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
  // The first axis, a unit vector in the base frame.
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
// A motion can be led to another goal in two ways. On the same way the position bows, by at most as much as
// the goal has moved. If the goal is on another way the motion turns off: it comes to rest on the straight
// way that it is on, and begins the straight way from there to the new goal at the same time. The position is
// the sum of both motions. So it stays within the triangle of the place where it turned off, the place where
// it would have come to rest, and the new goal.
class PoseMotion {
 public:
  void set_limits(const StreamLimits& limits) { limits_ = limits; }
  // At rest here.
  void place(const Eigen::Isometry3d& pose);

  // Moves on by `time` s towards `target` (finite), at no more than `part` of the limits of velocity. Turns
  // off if `way` is another number than before. While it leaves a way it goes to the first target of the new
  // one. It brakes instead, until the way is left, if the target has moved far from there or `way` changes
  // again: a few tenths of a second at most.
  void advance(const Eigen::Isometry3d& target, std::uint32_t way, double part, double time);
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
  void turn_off();
  Eigen::Vector3d leave(double time);
  MotionLimits limits_beside(const Eigen::Vector3d& way) const;

  StreamLimits limits_{};
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation_ = Eigen::Quaterniond::Identity();
  AxesMotion linear_;
  AxesMotion angular_;
  std::uint32_t way_ = 0;                                // number of the way of linear_
  AxesMotion left_;                                      // on the way that is being left: it comes to rest
  Eigen::Vector3d left_rest_ = Eigen::Vector3d::Zero();  // m, from here to where left_ comes to rest
  std::optional<Eigen::Vector3d> beside_;                // the goal of linear_ while left_ moves
};

// The rotation as a vector along its axis, as long as its angle (0 to pi rad); and back.
Eigen::Vector3d rotation_vector(const Eigen::Quaterniond& rotation);
Eigen::Quaterniond rotation_about(const Eigen::Vector3d& vector);

}  // namespace flexrf
