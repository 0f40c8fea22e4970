// MockGripper: fingers in memory, with an object, a fault or a silence where a test puts it.
#pragma once

#include "hal/driver/mock/mock_delay.hpp"
#include "hal/driver/mock/mock_noise.hpp"
#include "hal/gripper/interface/finger_control.hpp"
#include "mock_gripper_driver.hpp"

namespace flexrf {

/// Its fingers move as fast as commanded, without inertia. Tests call it between cycles, from the thread the
/// gripper lives in.
class MockGripper final : public MockGripperDriver {
 public:
  using Fault = FingerControl::Fault;

  Status initialise() override;

  GripperCapabilities capabilities() const noexcept override;
  std::optional<GripperState> state() const noexcept override { return state_; }
  const Status& trouble() const noexcept override { return control_.trouble(); }
  void halt() noexcept override;

  // ---- for tests

  FingerModel& fingers() noexcept { return control_.fingers(); }
  void set_fault(Fault which) noexcept { control_.set_fault(which); }
  /// The opening is told so much later, except by one of two states, which measures none.
  void set_delay(Duration delay) noexcept { delay_.set(delay); }
  /// The goal in force, speed and force too.
  const std::optional<GripperGoal>& goal() const noexcept { return control_.goal(); }

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
  std::optional<double> opening_;  // as it is told
  std::optional<GripperState> state_;
  Time last_cycle_{};
  MockNoise noise_;
  MockDelay<double> delay_;
};

}  // namespace flexrf
