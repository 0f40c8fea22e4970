// ArmSupervision: whether an arm does what it is commanded, and tells where it is.
#pragma once

#include <optional>
#include <span>

#include "base/status.hpp"
#include "base/time.hpp"
#include "motion/kinematic_chain.hpp"
#include "types/joint_state.hpp"

namespace flexrf {

/// A joint that sticks, sensors that freeze or fall silent: the unit plans on as if the arm followed, and
/// where it is then nobody knows. Each driver looks once a cycle, and what is found is its fault. The arm's
/// thread.
class ArmSupervision {
 public:
  struct Limits {
    double following_time = 0;  ///< s at a joint's greatest velocity that it may be behind; 0: however far
    double silence = 0;         ///< s without joint positions while it may move; 0: as long as it likes
  };

  /// The chain outlives this.
  void begin(const KinematicChain& chain, const Limits& limits) noexcept {
    *this = ArmSupervision{};
    chain_ = &chain;
    limits_ = limits;
  }
  /// Once a cycle, after it was received. `error`: of each joint, rad or m, as the drives that it has are
  /// asked to follow. `may_move` false: nothing is expected of it. device_fault: it does not follow;
  /// unavailable: it says nothing.
  Status look(const std::optional<JointState>& state, std::span<const double> error, bool may_move,
              Time now) noexcept;

 private:
  const KinematicChain* chain_ = nullptr;
  Limits limits_;
  Time heard_{};  // since it may move; no time: not yet
};

}  // namespace flexrf
