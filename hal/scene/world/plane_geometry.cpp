#include "hal/scene/world/plane_geometry.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace flexrf {
namespace {

// Corners this close to the foremost one lie on each other with it: sides that are parallel but for rounding
// touch along their length.
constexpr double on_each_other = 1e-6;  // m

/// Looks from each side of `first` at `second`. False: they are farther apart than `enough`.
bool look_from(const Outline& first, const Outline& second, double sign, double enough,
               Separation& found) noexcept {
  for (std::size_t i = 0; i < first.count; ++i) {
    const PlaneVector from = first.corners[i];
    const PlaneVector side = first.corners[i + 1 == first.count ? 0 : i + 1] - from;
    const PlaneVector normal = -left_of(unit(side));
    double nearest = std::numeric_limits<double>::max();
    for (const PlaneVector corner : second.all()) nearest = std::min(nearest, dot(normal, corner - from));
    if (nearest <= found.gap) continue;
    found.gap = nearest;
    found.normal = normal * sign;
    if (nearest > enough) return false;
  }
  return true;
}

/// What of an outline is foremost in a direction: from where to where along `side`.
struct Front {
  double at = -std::numeric_limits<double>::max();
  double low = 0;
  double high = 0;
};
Front front_of(const Outline& outline, PlaneVector direction, PlaneVector side) noexcept {
  Front front;
  for (const PlaneVector corner : outline.all()) front.at = std::max(front.at, dot(direction, corner));
  front.low = std::numeric_limits<double>::max();
  front.high = -front.low;
  for (const PlaneVector corner : outline.all()) {
    if (dot(direction, corner) < front.at - on_each_other) continue;
    front.low = std::min(front.low, dot(side, corner));
    front.high = std::max(front.high, dot(side, corner));
  }
  return front;
}

PlaneVector touching_point(const Outline& first, const Outline& second, PlaneVector normal) noexcept {
  const PlaneVector side = left_of(normal);
  const Front one = front_of(first, normal, side);
  const Front other = front_of(second, -normal, side);
  const double along = (std::max(one.low, other.low) + std::min(one.high, other.high)) / 2;
  return normal * ((one.at - other.at) / 2) + side * along;
}

}  // namespace

Separation separation_of(const Outline& first, const Outline& second, double enough) noexcept {
  Separation found;
  found.gap = -std::numeric_limits<double>::max();
  if (!look_from(first, second, 1, enough, found)) return found;
  if (!look_from(second, first, -1, enough, found)) return found;
  found.point = touching_point(first, second, found.normal);
  return found;
}

// Andrew 1979, Another efficient algorithm for convex hulls in two dimensions.
Outline hull_of(std::span<const PlaneVector> points) noexcept {
  constexpr std::size_t most_points = 64;
  std::array<PlaneVector, most_points> sorted;
  const std::size_t count = std::min(points.size(), most_points);
  std::copy_n(points.begin(), count, sorted.begin());
  std::sort(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(count),
            [](PlaneVector one, PlaneVector other) {
              return one.x < other.x || (one.x == other.x && one.y < other.y);
            });
  std::array<PlaneVector, 2 * most_points> chain;
  std::size_t size = 0;
  const auto grow = [&](PlaneVector point, std::size_t least) {
    while (size >= least && cross(chain[size - 1] - chain[size - 2], point - chain[size - 2]) <= 1e-14)
      --size;
    chain[size++] = point;
  };
  for (std::size_t i = 0; i < count; ++i) grow(sorted[i], 2);
  const std::size_t lower = size + 1;
  for (std::size_t i = count; i-- > 1;) grow(sorted[i - 1], lower);
  if (size > 1) --size;  // the first once more
  Outline hull;
  // Of more corners than an outline has, every so manieth: what is left out is a sliver.
  const std::size_t step = (size + most_corners - 1) / most_corners;
  for (std::size_t i = 0; i < size; i += std::max<std::size_t>(step, 1)) hull.add(chain[i]);
  return hull;
}

// Sutherland and Hodgman 1974, Reentrant polygon clipping.
Outline cut_by(const Outline& outline, PlaneVector point, PlaneVector outward) noexcept {
  Outline result;
  const auto keep = [&result](PlaneVector corner) {
    if (result.count < most_corners) result.add(corner);
  };
  for (std::size_t i = 0; i < outline.count; ++i) {
    const PlaneVector from = outline.corners[i];
    const PlaneVector to = outline.corners[i + 1 == outline.count ? 0 : i + 1];
    const double before = dot(from - point, outward);
    const double after = dot(to - point, outward);
    if (before <= 0) keep(from);
    if ((before < 0 && after > 0) || (before > 0 && after < 0))
      keep(from + (to - from) * (before / (before - after)));
  }
  return result;
}

Extent extent_along(const Outline& outline, PlaneVector direction) noexcept {
  Extent extent{std::numeric_limits<double>::max(), -std::numeric_limits<double>::max()};
  for (const PlaneVector corner : outline.all()) {
    extent.low = std::min(extent.low, dot(corner, direction));
    extent.high = std::max(extent.high, dot(corner, direction));
  }
  return extent;
}

bool is_within(const Outline& outline, PlaneVector middle, PlaneVector size) noexcept {
  return std::all_of(outline.all().begin(), outline.all().end(), [&](PlaneVector corner) {
    return std::abs(corner.x - middle.x) <= size.x / 2 && std::abs(corner.y - middle.y) <= size.y / 2;
  });
}

}  // namespace flexrf
