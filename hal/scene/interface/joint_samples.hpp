// Where an arm's joints were at a time between two at which they were told.
#pragma once

#include <array>

#include "base/time.hpp"
#include "motion/kinematic_chain.hpp"

namespace flexrf {

/// As told at one time: rad or m, and per s.
struct JointSample {
  Time time{};
  std::array<double, max_joints> position{};
  std::array<double, max_joints> velocity{};
};

/// The cubic through both positions with both velocities (Hermite): of a motion with limited jerk it is off
/// by micrometres where samples are 10 ms apart. Two of the same time count as the first.
std::array<double, max_joints> joints_between(const JointSample& before, const JointSample& after,
                                              Time time) noexcept;
/// Straight on from the last one that is known.
std::array<double, max_joints> joints_after(const JointSample& last, Time time) noexcept;

}  // namespace flexrf
