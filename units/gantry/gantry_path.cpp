#include "units/gantry/gantry_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flexrf::user {
namespace {

// Shorter motions are no motion: far below any encoder's step.
constexpr double shortest_motion = 1e-9;  // m

}  // namespace

void GantryPath::seed(const GantryPoint& point) noexcept {
  start_ = target_ = point_ = point;
  moving_ = stopped_ = false;
}

bool GantryPath::plan(const GantryPoint& target, const GantryLimits& limits, double speed) noexcept {
  if (!std::isfinite(target[0]) || !std::isfinite(target[1]) || !(speed > 0) || !(speed <= 1)) return false;
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  limits_ = {unlimited, unlimited, unlimited};
  double longest = 0;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double distance = std::abs(target[axis] - point_[axis]);
    longest = std::max(longest, distance);
    if (distance <= 0) continue;
    limits_.velocity = std::min(limits_.velocity, speed * limits[axis].velocity / distance);
    limits_.acceleration = std::min(limits_.acceleration, speed * limits[axis].acceleration / distance);
    limits_.jerk = std::min(limits_.jerk, speed * limits[axis].jerk / distance);
  }
  start_ = point_;
  target_ = target;
  time_ = 0;
  stopped_ = false;
  moving_ = longest >= shortest_motion;
  if (moving_) profile_ = JerkProfile::rest_to_rest(1.0, limits_);
  return true;
}

void GantryPath::stop() noexcept {
  if (!moving_ || stopped_) return;
  profile_ = JerkProfile::stop(profile_.at(time_), limits_);
  time_ = 0;
  stopped_ = true;
}

void GantryPath::advance(double elapsed) noexcept {
  if (!moving_) return;
  time_ += elapsed;
  const bool over = time_ >= profile_.duration();
  if (over) moving_ = false;
  if (over && !stopped_) {
    point_ = target_;
    return;
  }
  const double along = std::clamp(over ? profile_.end().position : profile_.at(time_).position, 0.0, 1.0);
  for (std::size_t axis = 0; axis < 2; ++axis)
    point_[axis] = start_[axis] + along * (target_[axis] - start_[axis]);
}

}  // namespace flexrf::user
