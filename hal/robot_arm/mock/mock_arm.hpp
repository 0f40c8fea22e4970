// MockArm: gives the states that a test put in and records what is commanded.
#pragma once

#include <cstdint>

#include "hal/driver/mock/mock_delay.hpp"
#include "hal/driver/mock/mock_noise.hpp"
#include "hal/robot_arm/interface/robot_arm.hpp"
#include "mock_arm_driver.hpp"
#include "motion/kinematics.hpp"

namespace flexrf {

/// Follows each command perfectly by the next cycle, until a test says otherwise. Tests call it between
/// cycles, from the thread the arm lives in.
class MockArm final : public MockArmDriver {
 public:
  Status initialise() override {
    state_.emplace();
    state_->position_map() = home_position(*chain);
    noise_.seed(environment().seed);
    delay_.clear();
    tell(Time{});
    begin_supervision(configuration);
    return {};
  }

  std::optional<JointState> state() const noexcept override { return told_.state; }
  Time measured_at() const noexcept override { return told_.state ? told_.at : Time{}; }

  // ---- for tests

  /// Nothing: the sensors are silent.
  void set_state(const std::optional<JointState>& state) noexcept {
    state_ = state;
    tell(last_cycle_);
  }
  /// Its sensors tell so much later where it was.
  void set_delay(Duration delay) noexcept { delay_.set(delay); }
  void set_follows(bool on) noexcept { follows_ = on; }
  void trip_drives() noexcept { fail(Status::error(StatusCode::device_fault, "the mock's drives tripped")); }
  const std::optional<JointPositions>& commanded() const noexcept { return commanded_; }
  std::uint64_t commands() const noexcept { return commands_; }

 private:
  struct Told {
    std::optional<JointState> state;
    Time at{};
  };

  void take_in(const Tick& tick) noexcept override {
    move(tick);
    last_cycle_ = tick.now;
    tell(tick.now);
    supervise(tick.now);
  }
  void forget() noexcept override { commanded_.reset(); }
  void act(const Tick& /*tick*/) noexcept override {}
  void rest(const Tick& /*tick*/) noexcept override {}
  bool become_safe() noexcept override {
    commanded_.reset();
    return true;
  }
  void follow(const JointPositions& set_points) noexcept override {
    tell_limits_and_pace(set_points);
    commanded_ = set_points;
    ++commands_;
  }

  void move(const Tick& tick) noexcept {
    if (!commanded_ || !follows_ || !state_) return;
    const JointVector next = within_limits(*chain, commanded_->position_map());
    const double elapsed = last_cycle_ == Time{} ? 0 : seconds(tick.now - last_cycle_);
    if (elapsed > 0) state_->velocity_map() = (next - state_->position_map()) / elapsed;
    state_->position_map() = next;
  }
  void tell(Time now) noexcept {
    std::optional<JointState> measured = state_;
    if (state_ && commanded_) {
      feedback.following_error_map() =
          within_limits(*chain, commanded_->position_map()) - state_->position_map();
    } else {
      feedback.following_error_map().setZero();
    }
    if (measured) {
      for (std::size_t i = 0; i < chain->joint_count; ++i)
        measured->position[i] += noise_.around_zero(configuration.position_noise[i]);
    }
    told_ = delay_.pass({measured, now}, now);
  }

  std::optional<JointState> state_;  // where it is
  Told told_;
  std::optional<JointPositions> commanded_;
  std::uint64_t commands_ = 0;
  bool follows_ = true;
  Time last_cycle_{};
  MockNoise noise_;
  MockDelay<Told> delay_;
};

}  // namespace flexrf
