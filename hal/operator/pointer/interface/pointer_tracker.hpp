#pragma once

#include <cstddef>
#include <cstdint>

#include "types/pointer_state.hpp"

namespace flexrf {

/// Keeps account of a pointer, for its drivers. Belongs to one thread.
class PointerTracker {
 public:
  const PointerState& state() const noexcept { return state_; }

  /// The pointer is there. What was down before counts when it is pressed anew [pointer-tracker-2].
  void appear() noexcept {
    state_.present = true;
    state_.buttons = 0;
  }
  /// It is gone, and with it every button that was down [pointer-tracker-1].
  void vanish() noexcept {
    state_.present = false;
    state_.buttons = 0;
  }

  void move(std::int64_t x, std::int64_t y) noexcept {
    state_.x += x;
    state_.y += y;
  }
  /// In 1/120 of a detent.
  void turn(std::int64_t wheel, std::int64_t tilt) noexcept {
    state_.wheel += wheel;
    state_.tilt += tilt;
  }
  /// Others than the first eight are passed over [pointer-tracker-3].
  void press(std::size_t button) noexcept {
    if (!state_.present || button >= state_.presses.size()) return;
    state_.buttons |= 1U << button;
    ++state_.presses[button];
  }
  void let_go(std::size_t button) noexcept {
    if (button < state_.presses.size()) state_.buttons &= ~(1U << button);
  }

 private:
  PointerState state_{};
};

}  // namespace flexrf
