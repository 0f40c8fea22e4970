// SceneGripper: fingers in a scene, which says what they meet.
#pragma once

#include "hal/gripper/interface/finger_control.hpp"
#include "scene_gripper_driver.hpp"

namespace flexrf {

/// It tells the scene where its fingers are, and is told in the scene's next step where they are stopped.
/// While the scene says nothing they meet what they met last.
class SceneGripper final : public SceneGripperDriver {
 public:
  Status initialise() override;

  GripperCapabilities capabilities() const noexcept override;
  std::optional<GripperState> state() const noexcept override { return state_; }
  const Status& trouble() const noexcept override { return control_.trouble(); }
  void halt() noexcept override;

  /// For tests, between cycles, from the thread the gripper lives in.
  FingerControl& control() noexcept { return control_; }

 private:
  void hear(const Tick& tick) noexcept override;
  void begin_activation() noexcept override;
  void go(const GripperGoal& goal) noexcept override;
  bool is_ready() const noexcept override { return control_.is_ready(); }
  bool is_at_rest() const noexcept override { return control_.is_at_rest(); }
  void tell(const Tick& /*tick*/, bool /*safe*/) noexcept override {}

  /// What was commanded is known at once.
  void tell_known() noexcept;

  FingerControl control_;
  std::optional<GripperState> state_;
  Time last_cycle_{};
};

}  // namespace flexrf
