// MockGripper: fingers in memory, with an object, a fault or a silence where a test puts it.
#pragma once

#include "hal/driver/mock/mock_delay.hpp"
#include "hal/driver/mock/mock_noise.hpp"
#include "hal/gripper/interface/finger_model.hpp"
#include "hal/gripper/interface/gripper_report.hpp"
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
  void receive(const Tick& tick) noexcept override;
  void send(const Tick& tick) noexcept override;
  bool make_safe() noexcept override;

  GripperCapabilities capabilities() const noexcept override;
  std::optional<GripperState> state() const noexcept override { return state_; }
  const Status& trouble() const noexcept override { return trouble_; }
  void activate() noexcept override;
  void command(const GripperGoal& goal) noexcept override;
  void halt() noexcept override;

  // ---- for tests

  FingerModel& fingers() noexcept { return fingers_; }
  void set_fault(Fault which) noexcept;
  /// The opening is told so much later, except by one of two states, which measures none.
  void set_delay(Duration delay) noexcept { delay_.set(delay); }
  /// The goal in force, speed and force too.
  const std::optional<GripperGoal>& goal() const noexcept { return goal_; }

 private:
  void move(Duration elapsed) noexcept;
  void rest(GripperObject object) noexcept;
  void go(const GripperGoal& goal) noexcept;
  bool is_heard() const noexcept { return fault_ != Fault::silent && fault_ != Fault::off; }

  FingerModel fingers_{0, 1};
  Fault fault_ = Fault::none;
  std::optional<GripperState> state_;
  GripperState known_;  // told when it is heard
  Status trouble_;
  std::optional<GripperGoal> goal_;
  Duration spent_{};  // on what it is at
  bool activating_ = false;
  bool releasing_ = false;  // on account of make_safe()
  Time last_cycle_{};
  MockNoise noise_;
  MockDelay<double> delay_;
  GripperReport report_;
};

}  // namespace flexrf
