// ProfileProgress: whether an axis whose drive makes the profile comes nearer to its target.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/time.hpp"

namespace flexrf {

/// A target that the drive took and that it is not at yet.
struct ProfileTarget {
  double position = 0;    ///< unit
  double left = 0;        ///< of the way to it, unit, with a sign; to the nearer side with a modulo
  double speed = 0;       ///< that the drive is told, or at least has, unit/s, above 0
  const char* says = "";  ///< what the drive says of it, for a person; empty: nothing that helps
};

/// Whatever its profile: within `patience` it comes nearer by a tenth of what its speed makes in that time,
/// or of what is left, where that is less. Nothing is asked of the profile's shape, which is the drive's own
/// (linear, with a limited jerk, slower near its end), nor of its window. One thread.
class ProfileProgress {
 public:
  void forget() noexcept { goal_.reset(); }
  /// Once a cycle; nothing: it is not on its way. `patience` in s, above 0: longer than it takes to turn
  /// round. `least`: unit; nearer than this it may stay. How far it is away, if it does not come nearer.
  std::optional<double> look(const std::optional<ProfileTarget>& target, double patience, double least,
                             Time now) noexcept {
    if (!target || std::abs(target->left) <= least) {
      forget();
      return std::nullopt;
    }
    const double left = std::abs(target->left);
    const bool is_new = !goal_ || *goal_ != target->position;
    if (is_new || nearest_ - left >= std::min(target->speed * patience, nearest_) / 10) {
      goal_ = target->position;
      nearest_ = left;
      since_ = now;
    }
    if (seconds(now - since_) <= patience) return std::nullopt;
    return left;
  }

 private:
  std::optional<double> goal_;
  double nearest_ = 0;  // it was then, unit
  Time since_{};
};

}  // namespace flexrf
