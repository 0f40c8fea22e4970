// Where to begin to fit a part's outline to a contour.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "units/vision/outline_fit.hpp"

namespace flexrf::user {

/// A bounded list of poses to try. Allocates nothing.
class PoseStarts {
 public:
  static constexpr std::size_t most = 96;

  void clear() noexcept { count_ = 0; }
  std::span<const OutlinePose> all() const noexcept { return {poses_.data(), count_}; }

  /// False: the list is full.
  bool add(const OutlinePose& pose) noexcept;

  /// For a contour that is all of the part: its centroid, with angles 30 degrees apart as far as the part's
  /// symmetry tells them apart.
  void add_around(const PartModel& part, const Eigen::Vector2d& middle) noexcept;

  /// For a contour of which only pieces are the part's: a convex corner of the contour on each corner of the
  /// outline that turns about as much; of a part that looks the same at every angle places along the contour.
  /// Points that are no edge are passed over.
  void add_at_corners(const PartModel& part, std::span<const ContourPoint> points) noexcept;

 private:
  void add_corner(const PartModel& part, const ContourPoint& at, const Eigen::Vector2d& bisector,
                  double turn) noexcept;

  std::array<OutlinePose, most> poses_{};
  std::size_t count_ = 0;
};

}  // namespace flexrf::user
