#pragma once

#include <Eigen/Geometry>

#include "hal/interfaces/robot_arm/kinematics.hpp"
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

/// The quaternion's w is not negative, so that the same pose always has the same numbers.
inline Pose to_pose(const Eigen::Isometry3d& frame) {
  Eigen::Quaterniond orientation(frame.linear());
  if (orientation.w() < 0) orientation.coeffs() = -orientation.coeffs();
  Pose pose{};
  pose.position_map() = frame.translation();
  pose.orientation_map() = orientation.coeffs();
  return pose;
}

}  // namespace flexrf
