// Keyboard: keys that a person presses.
#pragma once

#include <optional>

#include "keyboard_interface.hpp"
#include "types/held_keys.hpp"
#include "types/key_event.hpp"

namespace flexrf {

/// Everything: the thread the keyboard lives in. is_closed() is true once no key will come and all were
/// read [keyboard-1].
class Keyboard : public KeyboardInterface {
 public:
  /// The next key press, if there is one [keyboard-2]. Never blocks.
  virtual std::optional<KeyEvent> read() noexcept = 0;
  /// Which keys are down, as of the last receive(); nothing where only presses are known [keyboard-3].
  virtual std::optional<HeldKeys> held_keys() const noexcept { return std::nullopt; }

  /// With an IO thread: publishes what is down, and what was pressed, as much as the queue has room for. The
  /// rest waits where it is, so that no key press is lost however fast they come [keyboard-4], and asks to be
  /// called again when no other key comes [keyboard-5].
  void receive(const Tick& tick) noexcept override {
    now_ = tick.now;
    for (int n = 0; n < most_keys_per_cycle && keys.is_connected() && keys.has_room(); ++n) {
      const std::optional<KeyEvent> event = read();
      if (!event) break;
      keys.push(*event, tick.now);
    }
    if (held.is_connected()) {
      if (const std::optional<HeldKeys> down = held_keys()) held.publish(*down, tick.now);
    }
    backed_up_ = keys.is_connected() && !keys.has_room();
  }

 protected:
  /// A reader as fast as the writer must not hold this thread for ever.
  static constexpr int most_keys_per_cycle = 64;
  /// How soon a driver whose queue is full asks to be called again: keys that nobody has room for would wake
  /// its thread for nothing.
  static constexpr Duration retry_interval = std::chrono::milliseconds(5);

  /// As of the last receive(); 0 before the first.
  Time now() const noexcept { return now_; }
  /// The queue was full when the last receive() ended.
  bool is_backed_up() const noexcept { return backed_up_; }

 private:
  Time now_{};
  bool backed_up_ = false;
};

}  // namespace flexrf
