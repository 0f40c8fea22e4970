#include "motion/jerk_profile.hpp"

#include <algorithm>
#include <cmath>

namespace flexrf {
namespace {

MotionState advance(const MotionState& from, double jerk, double time) {
  return {
      .position = from.position + time * (from.velocity + time * (from.acceleration / 2 + time * jerk / 6)),
      .velocity = from.velocity + time * (from.acceleration + time * jerk / 2),
      .acceleration = from.acceleration + time * jerk};
}

}  // namespace

JerkProfile JerkProfile::rest_to_rest(double distance, const MotionLimits& limits) {
  JerkProfile profile;
  const double length = std::abs(distance);
  if (length == 0) return profile;
  const auto [velocity, acceleration, jerk] = limits;

  // Time of each jerk, and of one whole acceleration from rest to the cruising velocity.
  double jerk_time = acceleration / jerk;
  double ramp_time = velocity / acceleration + jerk_time;
  if (velocity * jerk < acceleration * acceleration) {
    jerk_time = std::sqrt(velocity / jerk);
    ramp_time = 2 * jerk_time;
  }
  double cruise_time = length / velocity - ramp_time;
  if (cruise_time < 0) {  // too short to reach the velocity
    cruise_time = 0;
    jerk_time = acceleration / jerk;
    ramp_time = jerk_time / 2 + std::sqrt(jerk_time * jerk_time / 4 + length / acceleration);
    if (ramp_time < 2 * jerk_time) {  // nor the acceleration
      jerk_time = std::cbrt(length / (2 * jerk));
      ramp_time = 2 * jerk_time;
    }
  }
  const double plateau_time = std::max(0.0, ramp_time - 2 * jerk_time);
  const double signed_jerk = std::copysign(jerk, distance);
  profile.append(jerk_time, signed_jerk);
  profile.append(plateau_time, 0);
  profile.append(jerk_time, -signed_jerk);
  profile.append(cruise_time, 0);
  profile.append(jerk_time, -signed_jerk);
  profile.append(plateau_time, 0);
  profile.append(jerk_time, signed_jerk);
  profile.end_ = {.position = distance};  // exactly, whatever the rounding on the way
  return profile;
}

JerkProfile JerkProfile::stop(const MotionState& from, const MotionLimits& limits) {
  JerkProfile profile;
  profile.end_ = from;
  const double jerk = limits.jerk;
  const double most = std::max(limits.acceleration, std::abs(from.acceleration));
  // The velocity left once the present acceleration has been taken off: its sign says which way to brake.
  const double coasting = from.velocity + from.acceleration * std::abs(from.acceleration) / (2 * jerk);
  const double sign = coasting > 0 ? -1 : 1;
  const double acceleration = sign * from.acceleration;
  const double change = -sign * from.velocity;
  double peak = std::sqrt(std::max(0.0, jerk * change + acceleration * acceleration / 2));
  double plateau_time = 0;
  if (peak > most) {
    peak = most;
    plateau_time =
        std::max(0.0, (change - (2 * peak * peak - acceleration * acceleration) / (2 * jerk)) / peak);
  }
  profile.append(std::max(0.0, (peak - acceleration) / jerk), sign * jerk);
  profile.append(plateau_time, 0);
  profile.append(peak / jerk, -sign * jerk);
  profile.end_.velocity = 0;
  profile.end_.acceleration = 0;
  return profile;
}

MotionState JerkProfile::at(double time) const {
  if (!(time < duration_)) return end_;
  double rest = std::max(0.0, time);
  for (std::size_t i = 0; i < count_; ++i) {
    const Segment& segment = segments_[i];
    if (rest < segment.duration) return advance(segment.start, segment.jerk, rest);
    rest -= segment.duration;
  }
  return end_;
}

void JerkProfile::append(double duration, double jerk) {
  if (!(duration > 0)) return;
  segments_[count_++] = {duration, jerk, end_};
  end_ = advance(end_, jerk, duration);
  duration_ += duration;
}

}  // namespace flexrf
