#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "types/joystick_state.hpp"

namespace flexrf {

/// What an axis can say: of its ends, and how far from its centre it still says nothing (its maker's word).
struct JoystickRange {
  double lowest = -1;
  double highest = 1;
  double flat = 0;
};

/// From -1 to 1 [joystick-tracker-1]. The dead zone, a part (at most 0.9) of the way from the centre to
/// either end, or what the maker says if that is more [joystick-tracker-2], is 0; what is outside it begins
/// at 0, so that nothing jumps [joystick-tracker-3]. A range without extent, or a value that is no number, is
/// 0 [joystick-tracker-4].
inline double deflection(double value, const JoystickRange& range, double dead_zone) noexcept {
  const double half = (range.highest - range.lowest) / 2;
  if (!(half > 0)) return 0;
  const double part = (value - range.lowest) / half - 1;
  const double dead = std::min(std::max(dead_zone, range.flat / half), 0.9);
  if (part > dead) return std::min((part - dead) / (1 - dead), 1.0);
  if (part < -dead) return std::max((part + dead) / (1 - dead), -1.0);
  return 0;
}

/// Keeps account of a joystick, for its drivers. Belongs to one thread.
class JoystickTracker {
 public:
  const JoystickState& state() const noexcept { return state_; }

  /// The joystick is there, at rest: what is deflected or down counts when it is moved or pressed
  /// anew [joystick-tracker-6].
  void appear() noexcept { begin(true); }
  /// It is gone, and with it every deflection and every button that was down [joystick-tracker-5].
  void vanish() noexcept { begin(false); }

  /// What it lacks a place for is passed over [joystick-tracker-7].
  void deflect(std::size_t axis, double deflection) noexcept {
    if (state_.present && axis < state_.axes.size()) state_.axes[axis] = deflection;
  }
  void press(std::size_t button) noexcept {
    if (!state_.present || button >= state_.presses.size()) return;
    state_.buttons |= 1U << button;
    ++state_.presses[button];
  }
  void let_go(std::size_t button) noexcept {
    if (button < state_.presses.size()) state_.buttons &= ~(1U << button);
  }

 private:
  void begin(bool present) noexcept {
    state_.present = present;
    state_.axes.fill(0);
    state_.buttons = 0;
  }

  JoystickState state_{};
};

}  // namespace flexrf
