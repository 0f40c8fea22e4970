// JointPace: whether an arm is led faster than its joints may go.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "motion/kinematic_chain.hpp"
#include "runtime/unit/restraint.hpp"

namespace flexrf {

/// What it says when this joint, from 0, is led faster than it may go.
inline Restraint outpaced(std::size_t joint, double asked, double given) noexcept {
  // Each joint's own words, as a restraint keeps none.
  static constexpr const char* reasons[max_joints] = {
      "joint 1 is led faster than it may go or accelerate, and falls behind",
      "joint 2 is led faster than it may go or accelerate, and falls behind",
      "joint 3 is led faster than it may go or accelerate, and falls behind",
      "joint 4 is led faster than it may go or accelerate, and falls behind",
      "joint 5 is led faster than it may go or accelerate, and falls behind",
      "joint 6 is led faster than it may go or accelerate, and falls behind",
      "joint 7 is led faster than it may go or accelerate, and falls behind",
      "joint 8 is led faster than it may go or accelerate, and falls behind"};
  return {reasons[joint], asked, given};
}

/// A joint keeps to its greatest velocity whatever it is commanded, and falls behind. How far, this tells
/// from the commands alone, so that a joint that sticks, which is a fault, is not mistaken for it. One
/// thread; never blocks, never allocates.
class JointPace {
 public:
  /// Nothing is wanted, and where the joints are is not known.
  void forget() noexcept { is_led_ = false; }
  /// The positions wanted from now on, finite, rad or m; `at`: where the joints are, which counts for the
  /// first command. What is beyond a joint's range is another restraint's, and wanted up to there only.
  void command(const KinematicChain& chain, std::span<const double> wanted,
               std::span<const double> at) noexcept;
  /// Once a cycle, `elapsed` seconds after the one before: the first joint that is behind by more than
  /// another cycle makes up for. What a cycle that came early or late makes of a motion at the greatest
  /// velocity is less.
  Restraint look(const KinematicChain& chain, double elapsed) noexcept;

 private:
  bool is_led_ = false;
  std::array<double, max_joints> at_{};  // as fast as they may
  std::array<double, max_joints> wanted_{};
};

}  // namespace flexrf
