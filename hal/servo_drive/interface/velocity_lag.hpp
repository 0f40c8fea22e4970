// VelocityLag: how far an axis that is led by velocities is behind the way that they make.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/time.hpp"

namespace flexrf {

/// A conveyor that is jammed, or an encoder that is frozen, has no following error: nobody told it a
/// position. It is compared with an axis that comes to the velocity with its acceleration, over a stretch of
/// the way, so that one that is a little slower than it is told is not ever farther behind. One thread.
class VelocityLag {
 public:
  void forget() noexcept { *this = VelocityLag{}; }
  /// Once a cycle. `asked`: what the drive is told, unit/s; `acceleration`: unit/s^2, above 0; `stretch`:
  /// unit, above 0; `modulo`: unit, 0 is none. How far it is behind in this stretch, unit.
  double look(double asked, double acceleration, double position, double stretch, double modulo,
              Time now) noexcept {
    const double elapsed = before_ ? seconds(now - at_) : 0;
    const double moved = before_ ? position - *before_ : 0;
    before_ = position;
    at_ = now;
    const double change = acceleration * elapsed;
    velocity_ += std::clamp(asked - velocity_, -change, change);
    if (asked * velocity_ <= 0 || wanted_ > stretch) wanted_ = gone_ = 0;
    if (asked * velocity_ <= 0) return 0;
    wanted_ += std::abs(velocity_) * elapsed;
    gone_ += std::copysign(1.0, velocity_) * (modulo > 0 ? std::remainder(moved, modulo) : moved);
    return wanted_ - gone_;
  }

 private:
  double velocity_ = 0;  // that it should have
  double wanted_ = 0;    // of this stretch
  double gone_ = 0;
  std::optional<double> before_;
  Time at_{};
};

}  // namespace flexrf
