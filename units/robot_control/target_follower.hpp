// TargetFollower: moves the arm to the latest target whenever the motion before is finished.
//
// The target is a pose of the tool; the motion is planned in joint space: all joints start and arrive
// together on a jerk-limited profile. So every posture on the way can be reached and no singularity asks for
// infinite rates; the price is that the tool does not run on a straight line between two targets.
#pragma once

#include <optional>

#include "types/target_answer.hpp"
#include "units/arm_motion/arm_motion.hpp"
#include "units/robot_control/motion_source.hpp"

namespace flexrf::user {

class TargetFollower final : public MotionSource {
 public:
  // Before anything else. The chain outlives this.
  void use(const KinematicChain& chain) noexcept;
  // The tool rests at `here`: where a target that is refused goes back to.
  void start(const Pose& here) noexcept { kept_ = here; }

  // Whether it was neither moved to nor refused nor left.
  bool is_pending(const Pose& wanted) const noexcept;
  // It is not followed, now or later. True: it was pending.
  bool leave(const Pose& wanted) noexcept;
  // The one that is moved to is looked at anew afterwards.
  void interrupt() noexcept;
  // While this leads the arm. What became of the target, once for each.
  std::optional<TargetAnswer> follow(const Pose& wanted, double speed) noexcept;
  // Why the latest target was refused; empty: it was not.
  const char* refusal() const noexcept { return refusal_.cause(); }

  void begin(const JointVector& set_point) noexcept override { motion_.seed(set_point); }
  void advance(double elapsed, bool goes_on) noexcept override;
  bool is_at_rest() const noexcept override { return !motion_.is_moving(); }
  const JointVector& set_point() const noexcept override { return motion_.set_point(); }
  Restraint restraint() const noexcept override { return {}; }

 private:
  ArmMotion motion_;
  std::optional<Pose> handled_;  // the target that was moved to, refused or left
  Pose kept_{};                  // the last one moved to, or where the arm was seeded
  Status refusal_;
};

}  // namespace flexrf::user
