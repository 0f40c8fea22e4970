// Convex outlines on the table: whether they overlap, and by how much.
#pragma once

#include <span>

#include "hal/scene/interface/part_catalogue.hpp"

namespace flexrf {

/// Of two convex outlines, by the separating axis theorem (Gottschalk 1996): among the normals of all sides
/// the one that sees them farthest apart.
struct Separation {
  double gap = 0;      ///< m; below 0 they overlap, and so far one has to move along `normal`
  PlaneVector normal;  ///< unit vector from the first to the second
  PlaneVector point;   ///< where they touch, when they overlap: in the middle of what lies on each other
};
/// One that is found to be farther apart than `enough` is not looked at further: its gap is more than that,
/// and it has no point.
Separation separation_of(const Outline& first, const Outline& second, double enough = 0) noexcept;

/// Convex, of any points; at most most_corners of its corners, those kept are of the hull.
Outline hull_of(std::span<const PlaneVector> points) noexcept;

/// What of a convex outline lies on the side to which `outward` does not point, of a line through `point`.
Outline cut_by(const Outline& outline, PlaneVector point, PlaneVector outward) noexcept;

/// How far it reaches along a unit vector, from the origin.
struct Extent {
  double low = 0;
  double high = 0;
};
Extent extent_along(const Outline& outline, PlaneVector direction) noexcept;

/// The whole of `outline` lies within a rectangle with sides along x and y.
bool is_within(const Outline& outline, PlaneVector middle, PlaneVector size) noexcept;

/// Mean square of the distance from the outline's centroid, over its area, in m^2: of one about its centroid,
/// which may be concave.
constexpr double square_of_gyration(const Outline& outline) noexcept {
  double area = 0;
  double moment = 0;
  for (std::size_t i = 0; i < outline.count; ++i) {
    const PlaneVector one = outline.corners[i];
    const PlaneVector next = outline.corners[i + 1 == outline.count ? 0 : i + 1];
    const double piece = cross(one, next);
    area += piece / 2;
    moment += piece / 12 * (dot(one, one) + dot(one, next) + dot(next, next));
  }
  return moment / area;
}

}  // namespace flexrf
