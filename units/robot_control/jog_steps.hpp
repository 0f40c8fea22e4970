// JogSteps: moves the tool or a joint by one increment, and finishes it.
//
// The tool's steps are straight lines of a PoseStream; a joint's are JointJog's. One is begun only where its
// end can be reached, and nothing but a stop interrupts it.
#pragma once

#include <optional>

#include "base/status.hpp"
#include "motion/pose_stream.hpp"
#include "units/robot_control/jog_wish.hpp"
#include "units/robot_control/joint_jog.hpp"
#include "units/robot_control/motion_source.hpp"

namespace flexrf::user {

class JogSteps final : public MotionSource {
 public:
  struct Speeds {
    StreamLimits tool;       // its velocities are those of a step
    double joint_share = 1;  // of a joint's velocity
  };

  // Before anything else. The chain outlives this. `tool_speed`: the most, in m/s, also in a joint's step.
  void use(const KinematicChain& chain, double tool_speed) noexcept;

  // It is begun when the arm rests and this leads it.
  void ask(const StepWish& wish, const Speeds& speeds) noexcept;
  // None is asked for or under way any more.
  void cancel() noexcept;
  // One is asked for, or under way.
  bool is_wanted() const noexcept { return asked_ || is_under_way_; }
  // Why the last step was refused or ended early; ok: it was not.
  const Status& refusal() const noexcept { return refusal_; }
  void forget_refusal() noexcept { refusal_ = {}; }

  void begin(const JointVector& set_point) noexcept override;
  void advance(double elapsed, bool goes_on) noexcept override;
  bool is_at_rest() const noexcept override { return leading().is_at_rest(); }
  const JointVector& set_point() const noexcept override { return leading().set_point(); }
  Restraint restraint() const noexcept override { return leading().restraint(); }

 private:
  // The tool's stream as a MotionSource.
  class ToolStep final : public MotionSource {
   public:
    PoseStream stream;
    Eigen::Isometry3d goal = Eigen::Isometry3d::Identity();

    void begin(const JointVector& set_point) noexcept override { stream.seed(set_point); }
    void advance(double elapsed, bool goes_on) noexcept override;
    bool is_at_rest() const noexcept override { return stream.is_at_rest(); }
    const JointVector& set_point() const noexcept override { return stream.set_point(); }
    Restraint restraint() const noexcept override { return stream.restraint(); }
  };

  const MotionSource& leading() const noexcept;
  MotionSource& leading() noexcept;
  Status begin_tool_step(const JointVector& set_point) noexcept;
  bool is_finished() const noexcept;

  const KinematicChain* chain_ = nullptr;
  ToolStep tool_;
  JointJog joint_;
  bool of_joint_ = false;
  std::optional<StepWish> asked_;
  Speeds speeds_;
  bool is_under_way_ = false;
  Status refusal_;
};

}  // namespace flexrf::user
