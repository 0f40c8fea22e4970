// MockKeyboard: gives the keys that a test put in.
#pragma once

#include <array>
#include <cstddef>

#include "hal/interfaces/keyboard/keyboard.hpp"
#include "mock_keyboard_driver.hpp"

namespace flexrf {

/// press, close: between cycles, from the thread the keyboard lives in.
class MockKeyboard final : public MockKeyboardDriver {
 public:
  static constexpr std::size_t capacity = 256;

  /// False when `capacity` keys wait already, or the keyboard is closed.
  bool press(const KeyEvent& event) noexcept {
    if (closed_ || pressed_ - taken_ == capacity) return false;
    events_[pressed_++ % capacity] = event;
    return true;
  }
  void close() noexcept { closed_ = true; }

  std::optional<KeyEvent> read() noexcept override {
    if (taken_ == pressed_) return std::nullopt;
    return events_[taken_++ % capacity];
  }
  bool is_closed() const noexcept override { return closed_ && taken_ == pressed_; }
  Time next_event() const noexcept override { return taken_ == pressed_ ? Time::max() : Time{}; }

 private:
  std::array<KeyEvent, capacity> events_{};
  std::size_t pressed_ = 0;
  std::size_t taken_ = 0;
  bool closed_ = false;
};

}  // namespace flexrf
