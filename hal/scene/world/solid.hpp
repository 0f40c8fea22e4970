// Solid: what moves through the scene and pushes: a finger, a palm, an arm's link.
#pragma once

#include <Eigen/Core>
#include <array>

#include "hal/scene/interface/part_catalogue.hpp"
#include "hal/scene/world/plane_geometry.hpp"

namespace flexrf {

/// A link: all within `radius` of a line; in m, in the scene's frame.
struct Capsule {
  Eigen::Vector3d from = Eigen::Vector3d::Zero();
  Eigen::Vector3d to = Eigen::Vector3d::Zero();
  double radius = 0;
  bool stands = false;  ///< it carries the arm, and belongs onto the table
};

class Solid {
 public:
  Solid() noexcept { corners_.fill(Eigen::Vector3d::Zero()); }
  /// A cuboid, its corners as corners_of() gives them.
  explicit Solid(const std::array<Eigen::Vector3d, 8>& corners) noexcept;
  explicit Solid(const Capsule& capsule) noexcept;

  /// What of it is between two heights, as seen from above; without corners: nothing is. Of a capsule it is
  /// up to 4 % too wide, and at its rounded ends as wide as in its middle.
  Outline section(double low, double high) const noexcept;

  double low() const noexcept { return low_; }    ///< m, its lowest point
  double high() const noexcept { return high_; }  ///< m
  PlaneVector middle() const noexcept { return middle_; }
  double reach() const noexcept { return reach_; }  ///< m about its middle, as seen from above
  bool stands() const noexcept { return stands_; }

 private:
  void bound(double margin) noexcept;

  std::array<Eigen::Vector3d, 8> corners_;  // of a capsule the first two, its line's ends
  std::size_t count_ = 0;
  double radius_ = 0;
  double low_ = 0;
  double high_ = 0;
  PlaneVector middle_;
  double reach_ = 0;
  bool stands_ = false;
};

}  // namespace flexrf
