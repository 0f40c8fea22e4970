// A pinhole camera: where points of the scene are seen in its picture.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "hal/scene/interface/scene_math.hpp"

namespace flexrf {

/// The camera's frame has z along its axis, x to the picture's right and y downwards. The middle of the pixel
/// in column c and row r is at (c, r), so the middle of 640 columns is 319.5.
struct Pinhole {
  std::uint32_t width = 640;   ///< pixels in a row
  std::uint32_t height = 480;  ///< rows
  double focal_length = 600;   ///< in pixels
  double centre_column = 319.5;
  double centre_row = 239.5;

  /// Of a point in the camera's frame, in front of it: column and row.
  PlaneVector project(const Eigen::Vector3d& point) const noexcept {
    return {centre_column + focal_length * point.x() / point.z(),
            centre_row + focal_length * point.y() / point.z()};
  }
  /// The direction in the camera's frame that is seen there; its z is 1.
  Eigen::Vector3d direction(double column, double row) const noexcept {
    return {(column - centre_column) / focal_length, (row - centre_row) / focal_length, 1};
  }
};

}  // namespace flexrf
