// MockGripper: fingers in memory, with an object, a fault or a silence where a test puts it.
#pragma once

#include "hal/driver/mock/mock_delay.hpp"
#include "hal/driver/mock/mock_noise.hpp"
#include "hal/gripper/interface/finger_model.hpp"
#include "mock_gripper_driver.hpp"

namespace flexrf {

/// Its fingers move as fast as commanded, without inertia. Tests call it between cycles, from the thread the
/// gripper lives in.
class MockGripper final : public MockGripperDriver {
 public:
  enum class Fault : std::uint8_t {
    none,
    silent,   ///< it is not heard
    stuck,    ///< the fingers do not move
    tripped,  ///< it reports a fault of its own, until activate()
    off,      ///< without power: not heard, and afterwards not activated
  };

  Status initialise() override;

  GripperCapabilities capabilities() const noexcept override;
  std::optional<GripperState> state() const noexcept override { return state_; }
  const Status& trouble() const noexcept override { return trouble_; }
  void halt() noexcept override;

  // ---- for tests

  FingerModel& fingers() noexcept { return fingers_; }
  void set_fault(Fault which) noexcept;
  /// The opening is told so much later, except by one of two states, which measures none.
  void set_delay(Duration delay) noexcept { delay_.set(delay); }
  /// The goal in force, speed and force too.
  const std::optional<GripperGoal>& goal() const noexcept { return goal_; }

 private:
  void hear(const Tick& tick) noexcept override;
  void begin_activation() noexcept override;
  void go(const GripperGoal& goal) noexcept override;
  bool is_ready() const noexcept override { return is_heard() && known_.activated; }
  bool is_at_rest() const noexcept override { return !known_.moving; }
  void tell(const Tick& /*tick*/, bool /*safe*/) noexcept override {}

  void move(Duration elapsed) noexcept;
  void stand_still(GripperObject object) noexcept;
  bool is_heard() const noexcept { return fault_ != Fault::silent && fault_ != Fault::off; }

  FingerModel fingers_{0, 1};
  Fault fault_ = Fault::none;
  std::optional<GripperState> state_;
  GripperState known_;  // told when it is heard
  Status trouble_;
  std::optional<GripperGoal> goal_;
  Duration spent_{};  // on what it is at
  bool activating_ = false;
  Time last_cycle_{};
  MockNoise noise_;
  MockDelay<double> delay_;
};

}  // namespace flexrf
