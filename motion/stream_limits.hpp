#pragma once

#include "motion/jerk_profile.hpp"

namespace flexrf {

// What the tool of an online stream keeps to: magnitudes of the vectors in the base frame, all above 0 and
// finite.
struct StreamLimits {
  MotionLimits linear;   // of the tool's origin: m/s, m/s^2, m/s^3
  MotionLimits angular;  // of its orientation: rad/s, rad/s^2, rad/s^3
};

}  // namespace flexrf
