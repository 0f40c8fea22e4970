// JointJog: a hand moves joints, one or several, as long as it wants or by a step that is finished.
//
// Each joint is led by towards_position(): to the end of its range while it is jogged, to the end of its step
// in a step. So it keeps to its acceleration and jerk, and comes to rest at its end without being told. The
// tool is kept to its reduced speed by the Jacobian: the sum of what each joint alone would move it by, which
// a rotation of one joint does not change.
#pragma once

#include <array>

#include "base/status.hpp"
#include "motion/axis_motion.hpp"
#include "units/robot_control/motion_source.hpp"

namespace flexrf::user {

class JointJog final : public MotionSource {
 public:
  // Before anything else. The chain outlives this. `tool_speed`: the most, in m/s.
  void use(const KinematicChain& chain, double tool_speed) noexcept;

  // Once a cycle: how fast the joints shall move, per s. What is not a number is refused with its cause, and
  // nothing is wanted.
  Status want(const JointVector& rates) noexcept;
  bool is_wanted() const noexcept { return !wanted_.isZero(0); }

  // A step of one joint by `way`, at `rate` (per s, above 0), from this set-point. Refused where it leaves
  // the joint's range.
  Status begin_step(const JointVector& set_point, std::size_t joint, double way, double rate) noexcept;
  bool is_stepping() const noexcept { return step_ < max_joints; }
  void end_step() noexcept { step_ = max_joints; }

  void begin(const JointVector& set_point) noexcept override;
  void advance(double elapsed, bool goes_on) noexcept override;
  bool is_at_rest() const noexcept override;
  const JointVector& set_point() const noexcept override { return set_point_; }
  Restraint restraint() const noexcept override { return restraint_; }

 private:
  using Axes = std::array<MotionState, max_joints>;

  void read_rates(bool goes_on) noexcept;
  void keep_to_tool_speed() noexcept;
  Axes moved_on(double elapsed) const noexcept;
  double goal_of(std::size_t joint) const noexcept;

  const KinematicChain* chain_ = nullptr;
  double tool_speed_ = 0;
  Axes axes_{};
  JointVector set_point_ = JointVector::Zero();
  JointVector wanted_ = JointVector::Zero();  // per s, of a hand
  JointVector rates_ = JointVector::Zero();   // per s, in this cycle
  std::size_t step_ = max_joints;             // the joint of the step; max_joints: none is under way
  double step_goal_ = 0;
  double step_rate_ = 0;
  Restraint restraint_{};
};

}  // namespace flexrf::user
