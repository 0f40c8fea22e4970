// Joint positions for a tool that moves on in small steps, and what keeps them from it.
#pragma once

#include "motion/kinematics.hpp"

namespace flexrf {

// Moves `joints` (finite, within their limits) on to where the tool is at `pose`, near by, in `time` s, by
// Newton's method with damped least squares (Nakamura and Hanafusa 1986). When a joint would have to leave
// its range, or be faster than `part` of its greatest velocity, or the tool cannot come there, it is told,
// and `joints` stay. The last also where the arm is singular: what a tool needs there of its joints grows
// beyond every velocity, so that they tell first. Bounded, a few microseconds; allocates nothing.
Restraint track(const KinematicChain& chain, const Eigen::Isometry3d& pose, double time, double part,
                JointVector& joints);

}  // namespace flexrf
