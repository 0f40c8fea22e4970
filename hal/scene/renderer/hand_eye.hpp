// How a camera sits on a hand, and how much a calibration of it is off.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>

namespace flexrf {

struct HandEye {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< of the camera's frame, in the tool's
  double focal_length = 600;                               ///< in pixels
};

/// As large as they say, in a direction that the seed chooses; 0: none.
struct HandEyeErrors {
  double position = 0;      ///< m
  double orientation = 0;   ///< rad, about the camera's middle
  double focal_length = 0;  ///< as a part of it
};

/// Where the camera really is, when it is thought to be at `told`.
HandEye disturbed(const HandEye& told, const HandEyeErrors& errors, std::uint64_t seed) noexcept;

}  // namespace flexrf
