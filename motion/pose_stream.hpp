// PoseStream: leads an arm's tool to poses that come at irregular times and may change at any time, as visual
// servoing has them.
//
// In each cycle the tool moves on along the fastest way to rest at the latest pose that its limits in
// Cartesian space allow: of velocity, acceleration and jerk, for its position and its orientation each
// (pose_motion.hpp says how, and from where the mathematics is). So it never waits for a plan, and where no
// other pose comes it is at rest at the last one. From rest to a pose that stays the way is straight. Led on
// to another pose while it moves, it bows; told that another way begins, it turns off from one straight way
// into the next, and does not leave them farther than it needs to stop.
//
// The joints follow within their ranges and velocities (guarded_motion.hpp): where they could not, the tool
// is slowed down, or comes to rest before, on its way. Near a singularity joints would have to be too fast,
// so that it is slow there. What is less than asked for, restraint() tells.
#pragma once

#include <cstdint>
#include <optional>

#include "base/status.hpp"
#include "motion/guarded_motion.hpp"
#include "motion/pose_motion.hpp"

namespace flexrf {

// One thread. Allocates nothing.
class PoseStream {
 public:
  // Before anything else, and whenever limits change, at rest. `max_age` in s: when the latest pose is older,
  // the tool comes to rest, within its limits, and waits for another. The chain outlives this.
  void use(const KinematicChain& chain, const StreamLimits& limits, double max_age) noexcept;
  // At rest with these joint positions (rad or m, finite, within their limits), and nothing to go to.
  void seed(const JointVector& joints) noexcept;

  // Where the tool shall go, in the base frame, as of `age` s ago, at no more than `part` (above 0, to 1) of
  // the limits of velocity. With another `way` than before the tool turns off, from the straight way that it
  // is on into another one (pose_motion.hpp). invalid_argument, and the pose before holds, when one of them
  // is not finite or it is no pose.
  Status aim(const Eigen::Isometry3d& target, double age = 0, std::uint32_t way = 0,
             double part = 1) noexcept;
  // Nowhere: it comes to rest.
  void let_go() noexcept { target_.reset(); }

  // Moves on by `elapsed` s; nothing where that is not above 0.
  void advance(double elapsed) noexcept;

  // Joint positions to command now: rad, or m where a joint slides.
  const JointVector& set_point() const noexcept { return guarded_.joints(); }
  bool is_at_rest() const noexcept { return guarded_.motion().is_at_rest(); }
  // It rests at the latest pose.
  bool has_arrived() const noexcept;
  // There is no pose to go to that is young enough.
  bool is_stale() const noexcept { return !target_ || age_ > max_age_; }
  // Of what it is asked for, this is not done; none: all is. `reason` lives for ever.
  const Restraint& restraint() const noexcept { return guarded_.restraint(); }
  // The tool as it is commanded now.
  const PoseMotion& motion() const noexcept { return guarded_.motion(); }
  // Cycles in which joints' velocities had to go before the limits of the tool, as the way ahead is looked at
  // in places: none over the random streams of the tests.
  std::uint64_t emergencies() const noexcept { return guarded_.emergencies(); }

 private:
  GuardedMotion<PoseMotion> guarded_;
  std::optional<Eigen::Isometry3d> target_;
  std::uint32_t way_ = 0;  // on which the target lies
  double part_ = 1;        // of the limits of velocity
  double max_age_ = 0;
  double age_ = 0;  // s, of the target
};

// Whether it is finite, and its rotation is one.
bool is_pose(const Eigen::Isometry3d& pose) noexcept;

}  // namespace flexrf
