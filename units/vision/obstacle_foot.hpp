// Where an obstacle stands, from the outline of all that is seen of it.
#pragma once

#include <span>

#include "units/vision/contour.hpp"

namespace flexrf::user {

/// A disc on the table, in the robot's frame, that holds an obstacle's foot.
struct ObstacleFoot {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();  ///< m
  double radius = 0;                                 ///< m
  /// By which middle (x, y) and radius change when the obstacle is thought to be 1 m higher: the middle moves
  /// towards the point below the camera. Two views from different places tell the height by it.
  Eigen::Vector3d lean = Eigen::Vector3d::Zero();
};

/// Of a contour that was projected onto the table. What stands upright is seen with its foot where the
/// contour faces the point below the camera, and with its top's edge where it faces away: that is brought
/// back towards that point as a top at `height` (m) is. Where the contour runs along the line of sight it
/// says nothing. False: there are no points, or the camera is not above `height`.
bool find_foot(std::span<const ContourPoint> points, const CameraView& view, double height,
               ObstacleFoot& foot) noexcept;

}  // namespace flexrf::user
