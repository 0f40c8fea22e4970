// RobotControl: lets one of several things lead an arm at a time: a hand by steps, at the tool or at its
// joints, a stream of poses, or targets. Which of them may, the mode says; which of those that may and want
// to does, their order above.
//
// Each is a class of its own (MotionSource), and tells there how it moves the arm. One takes over from
// another where the other has come to rest on its way. A target from before is not gone back to.
#pragma once

#include "robot_control_unit.hpp"
#include "runtime/log/log.hpp"
#include "units/robot_control/jog_steps.hpp"
#include "units/robot_control/joint_jog.hpp"
#include "units/robot_control/servo_follower.hpp"
#include "units/robot_control/target_follower.hpp"
#include "units/robot_control/tool_jog.hpp"

namespace flexrf::user {

class RobotControl final : public RobotControlUnit {
 public:
  Status initialise() override;
  // The mode is changed at standstill only.
  Status accept(const Runtime& proposed) override;
  void step(const Tick& tick) override;
  bool is_idle() const noexcept override { return idle_; }

 private:
  void seed(const JointState& state) noexcept;
  void look(const Tick& tick) noexcept;
  MotionSource* choose(const View<Pose>& wanted) noexcept;
  void lead(MotionSource* chosen, const View<Pose>& wanted, double elapsed) noexcept;
  void follow(const Pose& wanted) noexcept;
  void tell(const MotionSource* chosen, const View<Pose>& wanted, const char* held) noexcept;
  void tell_why(const MotionSource* chosen, const View<Pose>& wanted, const char* held) noexcept;
  const char* reason_to_hold(const View<Pose>& wanted) const noexcept;
  RobotActivity activity() const noexcept;
  bool is_moving() const noexcept { return active_ != nullptr && !active_->is_at_rest(); }
  double elapsed_in(const Tick& tick) noexcept;
  void command(double elapsed) noexcept;
  void publish_lead() noexcept;
  void publish(const JointState& state) noexcept;
  StreamLimits hand_limits() const noexcept;
  StreamLimits servo_limits() const noexcept;

  // In the order in which they go before each other.
  JogSteps steps_;
  ToolJog tool_jog_;
  JointJog joint_jog_;
  ServoFollower servo_;
  TargetFollower targets_;

  MotionSource* active_ = nullptr;  // null: none since the arm was where it is now by others
  JointVector set_point_ = JointVector::Zero();
  Eigen::Vector3d tool_position_ = Eigen::Vector3d::Zero();  // of the set-point
  Status refused_wish_;                                      // what is no number, in this cycle
  const char* refused_by_mode_ = nullptr;                    // in this cycle
  bool has_ignored_target_ = false;                          // since the mode is manual
  bool followed_servo_ = false;                              // in the cycle before
  LogLimit refusals_;
  LogLimit losses_;
  Time last_cycle_{};
  bool is_seeded_ = false;
  bool is_to_be_seeded_ = false;  // it did not follow, or told nothing, since it was seeded
  bool stands_still_ = true;
  bool idle_ = true;
};

}  // namespace flexrf::user
