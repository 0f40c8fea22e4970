// GantryPath: the set-points of two axes on a straight line from rest to rest.
#pragma once

#include <array>

#include "motion/jerk_profile.hpp"

namespace flexrf::user {

/// Horizontal and vertical, in m.
using GantryPoint = std::array<double, 2>;

/// Of one axis: m/s, m/s^2, m/s^3; all above 0.
using GantryLimits = std::array<MotionLimits, 2>;

/// Both axes start and arrive together, none beyond its limits; a stop brakes on the line. Plain data; one
/// thread; nothing allocates.
class GantryPath {
 public:
  /// At rest at this point, whatever was before.
  void seed(const GantryPoint& point) noexcept;
  /// From where it is, at rest, to the target. `speed` in (0, 1] scales the limits. False, and it stays, when
  /// a number makes no sense.
  bool plan(const GantryPoint& target, const GantryLimits& limits, double speed) noexcept;
  /// Comes to rest within the limits, at or before the target.
  void stop() noexcept;
  /// `elapsed` s go by.
  void advance(double elapsed) noexcept;

  bool is_moving() const noexcept { return moving_; }
  const GantryPoint& point() const noexcept { return point_; }
  /// Where it ends, unless it is stopped.
  const GantryPoint& target() const noexcept { return target_; }

 private:
  GantryPoint start_{};
  GantryPoint target_{};
  GantryPoint point_{};
  MotionLimits limits_{};  // of the path coordinate, which runs from 0 to 1
  JerkProfile profile_;
  double time_ = 0;  // s, in the profile
  bool moving_ = false;
  bool stopped_ = false;
};

}  // namespace flexrf::user
