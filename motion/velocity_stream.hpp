// VelocityStream: moves and turns an arm's tool as fast as somebody wants it now, as a hand at an arrow or a
// joystick does.
//
// Velocities come at any time and are taken up with limited acceleration and jerk, for the tool's position
// and its orientation each (velocity_motion.hpp says how). From rest the tool moves off on a straight line,
// and stays on it until another direction is wanted. When nothing is wanted any more it brakes at once, and
// so it does when nobody has said for a while what is wanted.
//
// The joints follow within their ranges and velocities (guarded_motion.hpp): where they could not, the tool
// is slowed down, or comes to rest before, on its way. Near a singularity joints would have to be too fast,
// so that it is slow there. What is less than asked for, restraint() tells.
#pragma once

#include "base/status.hpp"
#include "motion/guarded_motion.hpp"
#include "motion/velocity_motion.hpp"

namespace flexrf {

// One thread. Allocates nothing.
class VelocityStream {
 public:
  // Before anything else, and whenever limits change, at rest. `max_age` in s: when what was wanted last is
  // older, nothing is. The chain outlives this.
  void use(const KinematicChain& chain, const StreamLimits& limits, double max_age) noexcept;
  // At rest with these joint positions (rad or m, finite, within their limits), and nothing is wanted.
  void seed(const JointVector& joints) noexcept;

  // How fast the tool shall move and turn, as of `age` s ago. What is beyond the limits is shortened to them,
  // and told. invalid_argument, and nothing is wanted, when it is not finite.
  Status want(const ToolVelocity& wanted, double age = 0) noexcept;

  // Moves on by `elapsed` s; nothing where that is not above 0.
  void advance(double elapsed) noexcept;

  // Joint positions to command now: rad, or m where a joint slides.
  const JointVector& set_point() const noexcept { return guarded_.joints(); }
  bool is_at_rest() const noexcept { return guarded_.motion().is_at_rest(); }
  bool is_stale() const noexcept { return age_ > max_age_; }
  // Of what it is asked for, this is not done; none: all is. `reason` lives for ever.
  const Restraint& restraint() const noexcept;
  // The tool as it is commanded now.
  const VelocityMotion& motion() const noexcept { return guarded_.motion(); }
  // Cycles in which joints' velocities had to go before the limits of the tool, as the way ahead is looked at
  // in places: none over the random streams of the tests.
  std::uint64_t emergencies() const noexcept { return guarded_.emergencies(); }

 private:
  GuardedMotion<VelocityMotion> guarded_;
  StreamLimits limits_{};
  ToolVelocity wanted_{};
  Restraint shortened_{};  // of what is wanted
  double max_age_ = 0;
  double age_ = 0;  // s, of what is wanted
};

}  // namespace flexrf
