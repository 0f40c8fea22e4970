// Which pixels a convex polygon covers.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "hal/scene/interface/scene_math.hpp"

namespace flexrf {

/// A face that was cut in front of the camera has at most so many corners.
inline constexpr std::size_t most_face_corners = 26;

/// The smallest whole number that is not less, kept within 0 to `most`.
inline std::int32_t rounded_up(double value, std::uint32_t most) noexcept {
  const double kept = std::clamp(value, 0.0, static_cast<double>(most));
  const auto whole = static_cast<std::int32_t>(kept);
  return whole + (static_cast<double>(whole) < kept ? 1 : 0);
}

/// Calls fill(row, first, end) for each row with pixels whose middle is inside: of two polygons with a common
/// side each pixel belongs to one. `corners`: columns and rows, in either order around, at most
/// most_face_corners.
template <class Fill>
void fill_convex(std::span<const PlaneVector> corners, std::uint32_t width, std::uint32_t height,
                 const Fill& fill) noexcept {
  struct Side {
    PlaneVector from;
    double slope = 0;
    double low = 0;
    double high = 0;
  };
  std::array<Side, most_face_corners> sides;
  std::size_t count = 0;
  double top = std::numeric_limits<double>::max();
  double bottom = -top;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const PlaneVector from = corners[i];
    const PlaneVector to = corners[i + 1 == corners.size() ? 0 : i + 1];
    top = std::min(top, from.y);
    bottom = std::max(bottom, from.y);
    // A level side crosses no row between it and the next.
    if (from.y == to.y) continue;
    sides[count++] = {from, (to.x - from.x) / (to.y - from.y), std::min(from.y, to.y),
                      std::max(from.y, to.y)};
  }
  const std::int32_t end_row = rounded_up(bottom, height);
  for (std::int32_t row = rounded_up(top, height); row < end_row; ++row) {
    double left = std::numeric_limits<double>::max();
    double right = -left;
    for (std::size_t i = 0; i < count; ++i) {
      const Side& side = sides[i];
      if (row < side.low || row >= side.high) continue;
      const double column = side.from.x + (row - side.from.y) * side.slope;
      left = std::min(left, column);
      right = std::max(right, column);
    }
    if (left > right) continue;
    const std::int32_t first = rounded_up(left, width);
    const std::int32_t end = rounded_up(right, width);
    if (first < end) fill(row, first, end);
  }
}

}  // namespace flexrf
