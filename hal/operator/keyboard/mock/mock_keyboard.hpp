// MockKeyboard: gives the keys that a test put in.
#pragma once

#include <array>
#include <cstddef>

#include "hal/driver/mock/mock_plan.hpp"
#include "hal/operator/keyboard/interface/key_tracker.hpp"
#include "hal/operator/keyboard/interface/keyboard.hpp"
#include "mock_keyboard_driver.hpp"

namespace flexrf {

/// press, hold, let_go, unplug, plug_in, close: between cycles, from the thread the keyboard lives in, or
/// planned.
class MockKeyboard final : public MockKeyboardDriver {
 public:
  static constexpr std::size_t capacity = 256;

  Status initialise() override {
    plan_.rewind();
    return refusal_;
  }
  void receive(const Tick& tick) noexcept override {
    plan_.follow(*this, tick.now);
    MockKeyboardDriver::receive(tick);
  }

  std::optional<KeyEvent> read() noexcept override {
    if (taken_ == pressed_) return std::nullopt;
    return events_[taken_++ % capacity];
  }
  std::optional<HeldKeys> held_keys() const noexcept override { return tracker_.held(); }
  bool is_closed() const noexcept override { return closed_ && taken_ == pressed_; }
  Time next_event() const noexcept override { return taken_ == pressed_ ? plan_.next_event() : Time{}; }

  // ---- for tests

  /// False when `capacity` keys wait already, or the keyboard is closed.
  bool press(const KeyEvent& event) noexcept {
    if (closed_ || pressed_ - taken_ == capacity) return false;
    events_[pressed_++ % capacity] = event;
    return true;
  }
  void hold(const KeyEvent& event) noexcept {
    if (press(event)) tracker_.press(event);
  }
  void let_go(const KeyEvent& event) noexcept { tracker_.let_go(event); }
  void unplug() noexcept { tracker_.vanish(); }
  void plug_in() noexcept { tracker_.appear(); }
  void close() noexcept { closed_ = true; }
  void plan(Duration after, void (*act)(MockKeyboard&)) { plan_.plan(after, act); }
  /// What initialise() is to answer.
  void refuse(const Status& refusal) noexcept { refusal_ = refusal; }

 private:
  std::array<KeyEvent, capacity> events_{};
  std::size_t pressed_ = 0;
  std::size_t taken_ = 0;
  bool closed_ = false;
  KeyTracker tracker_ = plugged_in();
  MockPlan<MockKeyboard> plan_;
  Status refusal_;

  static KeyTracker plugged_in() noexcept {
    KeyTracker tracker;
    tracker.appear();
    return tracker;
  }
};

}  // namespace flexrf
