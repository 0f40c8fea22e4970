// Contour: the outer boundary of a blob, projected onto the plane of a part's top and made its outline.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "units/vision/camera_view.hpp"
#include "units/vision/region_bitmap.hpp"

namespace flexrf::user {

/// On the plane of a part's top, in the robot's frame.
struct ContourPoint {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< m
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();    ///< unit vector, away from the part
  bool is_edge = false;  ///< false: the part may go on behind it, as at the border of what was looked at
};

/// Of one thread; allocates nothing.
class Contour {
 public:
  static constexpr std::size_t most_steps = 2048;  ///< along a blob's cells
  static constexpr std::size_t most_points = 256;

  /// Follows the boundary between the blob's cells and others, once around, and projects points of it, evenly
  /// chosen, onto the plane at `height` above the table.
  ///
  /// A camera that does not look from straight above sees sides of an upright prism beside its top. Where the
  /// contour faces away from the point below the camera it is the top's edge; where it faces that point it is
  /// the bottom's, and is moved to where the top's edge is above it. So all points belong to the one outline.
  /// A contour that runs towards that point is moved along itself, which changes nothing.
  ///
  /// False: the boundary is longer than most_steps, or the plane cannot be seen so.
  bool follow(const RegionBitmap& bitmap, const Blob& blob, const CameraView& view, double height) noexcept;

  std::span<const ContourPoint> points() const noexcept { return {points_.data(), count_}; }
  std::span<ContourPoint> points() noexcept { return {points_.data(), count_}; }
  /// Enclosed by the points, m^2.
  double area() const noexcept { return area_; }
  /// Part of the points that are an edge, and not where what was looked at ends.
  double seen() const noexcept;
  /// It runs along what is blind.
  bool meets_blind() const noexcept { return meets_blind_; }
  const Eigen::Vector2d& middle() const noexcept { return middle_; }  ///< centroid of that

 private:
  struct Step {
    float column = 0;  ///< of the bitmap's cells, whose first begins at 0
    float row = 0;
    bool is_edge = false;
  };
  bool trace(const RegionBitmap& bitmap, const Blob& blob) noexcept;
  bool project(const RegionBitmap& bitmap, const CameraView& view, double height) noexcept;
  void find_normals() noexcept;
  void measure() noexcept;

  std::array<Step, most_steps> steps_{};
  std::size_t step_count_ = 0;
  std::array<ContourPoint, most_points> points_{};
  std::size_t count_ = 0;
  bool meets_blind_ = false;
  double area_ = 0;
  Eigen::Vector2d middle_ = Eigen::Vector2d::Zero();
};

}  // namespace flexrf::user
