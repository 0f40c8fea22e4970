#pragma once

#include <Eigen/Geometry>

#include "motion/kinematics.hpp"
#include "types/pose.hpp"

namespace flexrf {

/// Not a number in, not a number out; a quaternion of any length but zero is normalised, zero is no rotation.
inline Eigen::Isometry3d to_isometry(const Pose& pose) {
  Eigen::Quaterniond orientation(Eigen::Vector4d(pose.orientation_map()));
  const double length = orientation.norm();
  if (length == 0) {
    orientation.setIdentity();
  } else {
    orientation.coeffs() /= length;
  }
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.linear() = orientation.toRotationMatrix();
  result.translation() = pose.position_map();
  return result;
}

/// Of the two quaternions that mean the same rotation, the one on this side (x, y, z, w). Any rule has
/// rotations beside which noise decides; these are none that a cell is built with. By the sign of w alone
/// they would be the half turns: a tool that points downwards.
inline constexpr double quaternion_side[4] = {0.4682, 0.2617, 0.1219, 0.8350};

/// The same pose always has the same numbers.
inline Pose to_pose(const Eigen::Isometry3d& frame) {
  Eigen::Quaterniond orientation(frame.linear());
  if (orientation.coeffs().dot(Eigen::Map<const Eigen::Vector4d>(quaternion_side)) < 0)
    orientation.coeffs() = -orientation.coeffs();
  Pose pose{};
  pose.position_map() = frame.translation();
  pose.orientation_map() = orientation.coeffs();
  return pose;
}

}  // namespace flexrf
