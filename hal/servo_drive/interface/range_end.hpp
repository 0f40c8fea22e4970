// How fast an axis may still be on its way to the end of its range.
#pragma once

#include <algorithm>
#include <cmath>

namespace flexrf {

/// The velocity, at most as it is asked for, with which an axis comes to rest at the end that it moves to:
/// that way is v * ahead + v^2 / (2 * deceleration). `left`: to that end, unit; below 0 beyond it. `ahead`:
/// s, above 0; who hears late of what it does and is led by this goes beyond the end unless it is e times as
/// long as that delay. `deceleration`: unit/s^2, above 0. With the sign of `asked`, unit/s.
inline double slowed_before_end(double asked, double left, double ahead, double deceleration) noexcept {
  const double at_once = deceleration * ahead;
  const double most = std::sqrt(at_once * at_once + 2 * deceleration * std::max(0.0, left)) - at_once;
  return std::copysign(std::min(std::abs(asked), most), asked);
}

}  // namespace flexrf
