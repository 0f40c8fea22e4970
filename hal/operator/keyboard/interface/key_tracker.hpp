#pragma once

#include <algorithm>

#include "types/held_keys.hpp"

namespace flexrf {

inline bool is_same_key(const KeyEvent& a, const KeyEvent& b) noexcept {
  return a.key == b.key && a.character == b.character;
}

inline bool is_held(const HeldKeys& held, const KeyEvent& key) noexcept {
  return std::any_of(held.keys.begin(), held.keys.begin() + held.count,
                     [&key](const KeyEvent& one) { return is_same_key(one, key); });
}

/// Keeps account of which keys are down, for drivers that learn of both ends of a press. Belongs to one
/// thread.
class KeyTracker {
 public:
  const HeldKeys& held() const noexcept { return held_; }

  /// The keyboard is there. What was down before counts when it is pressed anew [key-tracker-2].
  void appear() noexcept {
    held_ = {};
    held_.present = true;
  }
  /// It is gone, and with it everything that was down [key-tracker-1].
  void vanish() noexcept { held_ = {}; }

  void press(const KeyEvent& key) noexcept {
    if (held_.present && held_.count < held_.keys.size() && !is_held(held_, key))
      held_.keys[held_.count++] = key;
  }
  void let_go(const KeyEvent& key) noexcept {
    auto* const end = held_.keys.data() + held_.count;
    auto* const rest =
        std::remove_if(held_.keys.data(), end, [&key](const KeyEvent& one) { return is_same_key(one, key); });
    std::fill(rest, end, KeyEvent{});  // equal lists are equal bytes
    held_.count = static_cast<std::uint8_t>(rest - held_.keys.data());
  }

 private:
  HeldKeys held_{};
};

}  // namespace flexrf
