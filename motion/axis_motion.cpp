#include "motion/axis_motion.hpp"

#include <cmath>

namespace flexrf {
namespace {

// Nearer is there: far below any encoder's step.
constexpr double arrived = 1e-11;  // rad or m
// Halvings of a cycle until the time of the turning point is exact to rounding.
constexpr int halvings = 40;

}  // namespace

MotionState towards_velocity(const MotionState& from, double wanted, const MotionLimits& limits,
                             double time) {
  // Seen from a frame that moves with the wanted velocity, it is a stop.
  const JerkProfile stop = JerkProfile::stop(
      {.position = 0, .velocity = from.velocity - wanted, .acceleration = from.acceleration}, limits);
  const MotionState seen = stop.at(time);
  return {.position = from.position + seen.position + wanted * time,
          .velocity = seen.velocity + wanted,
          .acceleration = seen.acceleration};
}

double rest_position(const MotionState& from, const MotionLimits& limits) {
  return JerkProfile::stop(from, limits).end().position;
}

// The way is: towards the velocity limit on the target's side for as long as a stop from there does not pass
// the target, then that stop. The end of the stop moves towards the target as long as the first part lasts,
// so where it lies on the target is found by bisection; and only when that is within this cycle does anybody
// need to know.
MotionState towards_position(const MotionState& from, double target, const MotionLimits& limits,
                             double time) {
  const JerkProfile stop = JerkProfile::stop(from, limits);
  const double short_of = target - stop.end().position;
  if (std::abs(short_of) <= arrived) return stop.at(time);
  const double side = short_of > 0 ? 1 : -1;
  const double cruise = side * limits.velocity;
  const auto stops_before = [&](const MotionState& state) {
    return side * (target - rest_position(state, limits)) >= 0;
  };
  const MotionState on = towards_velocity(from, cruise, limits, time);
  if (stops_before(on)) return on;
  double early = 0;
  double late = time;
  for (int n = 0; n < halvings; ++n) {
    const double middle = (early + late) / 2;
    (stops_before(towards_velocity(from, cruise, limits, middle)) ? early : late) = middle;
  }
  const MotionState turning = towards_velocity(from, cruise, limits, early);
  return JerkProfile::stop(turning, limits).at(time - early);
}

}  // namespace flexrf
