// RobotControl: moves an arm to the latest target whenever the motion before is finished.
//
// The target is a pose of the tool; the motion is planned in joint space: all joints start and arrive
// together on a jerk-limited profile. So every posture on the way can be reached and no singularity asks for
// infinite rates; the price is that the tool does not run on a straight line between two targets.
//
// A velocity, as somebody at the machine holds it, goes before targets: the tool then moves on a straight
// line, with limited acceleration, and slower where joints would have to be too fast.
#pragma once

#include <optional>
#include <string_view>

#include "robot_control_unit.hpp"
#include "runtime/log/log.hpp"
#include "units/arm_motion/arm_motion.hpp"

namespace flexrf::user {

class RobotControl final : public RobotControlUnit {
 public:
  Status initialise() override;
  void step(const Tick& tick) override;
  bool is_idle() const noexcept override { return idle_; }

 private:
  void follow_target() noexcept;
  bool follow_velocity(bool allowed, double elapsed) noexcept;
  double elapsed_in(const Tick& tick) noexcept;
  void command(double elapsed) noexcept;
  void publish(const JointState& state) noexcept;
  void hold(std::string_view reason) noexcept;
  void refuse(const Status& cause) noexcept;

  ArmMotion motion_;
  std::optional<Pose> handled_;  // the target that was moved to or refused
  Pose kept_{};                  // the last one moved to, or where the arm was seeded
  LogLimit refusals_;
  bool held_ = false;                                        // the last cycle did not follow a target
  Eigen::Vector3d tool_velocity_ = Eigen::Vector3d::Zero();  // m/s, of the tool as a hand moves it
  Time last_cycle_{};
  bool idle_ = true;
};

}  // namespace flexrf::user
