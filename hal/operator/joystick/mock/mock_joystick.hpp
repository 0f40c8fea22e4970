// MockJoystick: a joystick that a test deflects.
#pragma once

#include "hal/driver/mock/mock_plan.hpp"
#include "hal/operator/joystick/interface/joystick.hpp"
#include "hal/operator/joystick/interface/joystick_tracker.hpp"
#include "mock_joystick_driver.hpp"

namespace flexrf {

/// What a hand does: between cycles, from the thread the joystick lives in, or planned.
class MockJoystick final : public MockJoystickDriver {
 public:
  Status initialise() override {
    hand_ = {};
    hand_.appear();
    plan_.rewind();
    feedback = {};
    return refusal_;
  }
  void receive(const Tick& tick) noexcept override {
    plan_.follow(*this, tick.now);
    told_ = hand_.state();
    feedback.present = told_.present;
    stick.publish(told_, tick.now);
  }
  Time next_event() const noexcept override { return plan_.next_event(); }
  const JoystickState& state() const noexcept override { return told_; }

  // ---- for tests

  /// To this part of its way from the centre, −1 to 1, with no dead zone taken off.
  void deflect(std::size_t axis, double part) noexcept {
    hand_.deflect(axis, deflection(part, {}, configuration.dead_zone));
  }
  void press(std::size_t button) noexcept { hand_.press(button); }
  void let_go(std::size_t button) noexcept { hand_.let_go(button); }
  void unplug() noexcept {
    hand_.vanish();
    ++feedback.losses;
  }
  void plug_in() noexcept { hand_.appear(); }
  void plan(Duration after, void (*act)(MockJoystick&)) { plan_.plan(after, act); }
  /// What initialise() is to answer.
  void refuse(const Status& refusal) noexcept { refusal_ = refusal; }

 private:
  JoystickTracker hand_;
  JoystickState told_{};
  MockPlan<MockJoystick> plan_;
  Status refusal_;
};

}  // namespace flexrf
