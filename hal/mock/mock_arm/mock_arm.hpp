// MockArm: gives the states that a test put in and records what is commanded.
#pragma once

#include <cmath>
#include <cstdint>

#include "hal/interfaces/robot_arm/kinematics.hpp"
#include "hal/interfaces/robot_arm/robot_arm.hpp"
#include "mock_arm_driver.hpp"

namespace flexrf {

/// Follows each command perfectly by the next cycle, until a test says otherwise. Tests call it between
/// cycles, from the thread the arm lives in.
class MockArm final : public MockArmDriver {
 public:
  Status initialise() override {
    state_.emplace();
    state_->position_map() = home_position(*chain);
    return {};
  }

  std::optional<JointState> state() const noexcept override { return state_; }

  void command(const JointPositions& set_points) noexcept override {
    if (is_inhibited()) return;
    if (!set_points.position_map().allFinite()) {
      fail(Status::error(StatusCode::invalid_argument,
                         "a joint was commanded to an angle that is not a number"));
      return;
    }
    commanded_ = set_points;
    ++commands_;
  }

  void receive(const Tick& tick) noexcept override {
    if (!commanded_ || !follows_ || !state_ || is_inhibited() || !fault().is_ok()) return;
    const JointVector next = within_limits(*chain, commanded_->position_map());
    const double elapsed = last_cycle_ == Time{} ? 0 : seconds(tick.now - last_cycle_);
    if (elapsed > 0) state_->velocity_map() = (next - state_->position_map()) / elapsed;
    state_->position_map() = next;
    last_cycle_ = tick.now;
  }

  bool make_safe() noexcept override {
    commanded_.reset();
    return true;
  }

  // ---- for tests

  /// Nothing: the sensors are silent.
  void set_state(const std::optional<JointState>& state) noexcept { state_ = state; }
  void set_follows(bool on) noexcept { follows_ = on; }
  void trip_drives() noexcept { fail(Status::error(StatusCode::device_fault, "the mock's drives tripped")); }
  const std::optional<JointPositions>& commanded() const noexcept { return commanded_; }
  std::uint64_t commands() const noexcept { return commands_; }

 private:
  std::optional<JointState> state_;
  std::optional<JointPositions> commanded_;
  std::uint64_t commands_ = 0;
  bool follows_ = true;
  Time last_cycle_{};
};

}  // namespace flexrf
