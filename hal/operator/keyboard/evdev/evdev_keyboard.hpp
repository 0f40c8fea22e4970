// EvdevKeyboard: a keyboard of the machine, through the kernel's input layer.
#pragma once

#include <array>
#include <cstddef>

#include "evdev_keyboard_driver.hpp"
#include "hal/operator/evdev/evdev_port.hpp"
#include "hal/operator/keyboard/interface/key_tracker.hpp"

namespace flexrf {

/// Keys are told by their place on a US keyboard. A key that is held is pressed once: the kernel's
/// repetitions are left out.
class EvdevKeyboard final : public EvdevKeyboardDriver {
 public:
  Status initialise() override;
  void stop() override { port_.end(); }
  void receive(const Tick& tick) noexcept override;

  std::optional<KeyEvent> read() noexcept override;
  std::optional<HeldKeys> held_keys() const noexcept override { return tracker_.held(); }
  int descriptor() const noexcept override { return port_.descriptor(); }
  /// Presses that the queue had no room for: the kernel no longer announces them.
  Time next_event() const noexcept override {
    return keys.is_connected() && taken_ != pressed_ ? now() + retry_interval : Time::max();
  }

 private:
  static constexpr std::size_t capacity = 256;

  void take(unsigned code, bool down) noexcept;

  EvdevPort port_;
  KeyTracker tracker_;
  bool left_shift_ = false;
  bool right_shift_ = false;
  // Presses that were not read yet. What is down must be known, so the kernel is not kept waiting for a
  // reader: who leaves more than these lying loses the newest.
  std::array<KeyEvent, capacity> presses_{};
  std::size_t pressed_ = 0;
  std::size_t taken_ = 0;
};

}  // namespace flexrf
