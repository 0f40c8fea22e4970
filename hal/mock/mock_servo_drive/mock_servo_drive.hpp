// MockServoDrive: is where it was commanded by the next cycle, and records what is commanded.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "hal/interfaces/servo_drive/servo_drive.hpp"
#include "mock_servo_drive_driver.hpp"

namespace flexrf {

/// Enabled a cycle after it may move, without inertia. Tests call it between cycles, from the thread the
/// drive lives in.
class MockServoDrive final : public MockServoDriveDriver {
 public:
  Status initialise() override {
    state_ = ServoState{};
    commanded_.reset();
    last_cycle_ = Time{};
    return {};
  }

  std::optional<ServoState> state() const noexcept override { return state_; }

  void command_position(double position) noexcept override {
    if (configuration.takes_velocities || !may_follow()) return;
    if (is_number(position)) take(std::clamp(position, configuration.lowest, configuration.highest));
  }
  void command_velocity(double velocity) noexcept override {
    if (!configuration.takes_velocities || !may_follow()) return;
    if (is_number(velocity)) take(std::clamp(velocity, -configuration.fastest, configuration.fastest));
  }

  void receive(const Tick& tick) noexcept override {
    const double elapsed = last_cycle_ == Time{} ? 0 : seconds(tick.now - last_cycle_);
    last_cycle_ = tick.now;
    if (!state_) return;
    if (!commanded_ || !may_follow()) {
      state_->velocity = 0;
    } else if (elapsed > 0) {
      move(elapsed);
    }
    feedback.position = state_->position;
    feedback.velocity = state_->velocity;
    feedback.following_error = state_->following_error;
    feedback.enabled = state_->enabled;
  }
  void send(const Tick& /*tick*/) noexcept override {
    if (state_) state_->enabled = !is_inhibited() && fault().is_ok();
    if (is_inhibited()) commanded_.reset();
  }
  bool make_safe() noexcept override {
    commanded_.reset();
    return true;
  }

  // ---- for tests

  /// Nothing: the drive is not heard.
  void set_state(const std::optional<ServoState>& state) noexcept { state_ = state; }
  void trip() noexcept { fail(Status::error(StatusCode::device_fault, "the mock's drive tripped")); }
  /// Of the position or velocity in force, within the configuration's limits.
  const std::optional<double>& commanded() const noexcept { return commanded_; }
  std::uint64_t commands() const noexcept { return commands_; }

 private:
  bool may_follow() const noexcept { return state_ && state_->enabled && !is_inhibited() && fault().is_ok(); }
  bool is_number(double value) noexcept {
    if (std::isfinite(value)) return true;
    fail(Status::error(StatusCode::invalid_argument, "the drive was commanded to what is not a number"));
    return false;
  }
  void take(double value) noexcept {
    commanded_ = value;
    ++commands_;
  }
  void move(double elapsed) noexcept {
    const double before = state_->position;
    const double most = configuration.fastest * elapsed;
    const double wanted =
        configuration.takes_velocities
            ? std::clamp(before + *commanded_ * elapsed, configuration.lowest, configuration.highest)
            : *commanded_;
    state_->position = before + std::clamp(wanted - before, -most, most);
    state_->velocity = (state_->position - before) / elapsed;
    state_->following_error = wanted - state_->position;
  }

  std::optional<ServoState> state_;
  std::optional<double> commanded_;
  std::uint64_t commands_ = 0;
  Time last_cycle_{};
};

}  // namespace flexrf
