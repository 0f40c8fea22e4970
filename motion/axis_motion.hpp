// Motion along one coordinate from any state, within limits, towards what may change at any time: what online
// streams are made of.
//
// Each function gives the state a time later on the fastest way with piecewise constant jerk. Asked again in
// each cycle, with the state that it gave before, the same goal leads along the same way, and another goal
// along another one from here on: Kröger, "On-Line Trajectory Generation in Robotic Systems" (2010), where
// this is the problem of type IV with a goal at rest; Berscheid and Kröger's Ruckig (2021) solves it for
// goals in motion and several coordinates at a time, which these functions do not.
//
// Velocity and acceleration stay within their limits when they were so at first, and are led back into them
// when they were not. Finite numbers, limits above 0; nothing allocates.
#pragma once

#include "motion/jerk_profile.hpp"

namespace flexrf {

// `time` s (0 or more) later on the fastest way to the velocity `wanted`, which is kept from then on.
MotionState towards_velocity(const MotionState& from, double wanted, const MotionLimits& limits, double time);

// Where the fastest stop from here ends.
double rest_position(const MotionState& from, const MotionLimits& limits);

// `time` s later on the fastest way to rest at `target`. It overshoots only when it is too fast to stop
// before.
MotionState towards_position(const MotionState& from, double target, const MotionLimits& limits, double time);

}  // namespace flexrf
