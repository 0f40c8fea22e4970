// Keyboard: keys that a person presses.
#pragma once

#include <optional>

#include "keyboard_interface.hpp"
#include "types/key_event.hpp"

namespace flexrf {

/// Everything: the thread the keyboard lives in. is_closed() is true once no key will come and all were read.
class Keyboard : public KeyboardInterface {
 public:
  /// The next key press, if there is one. Never blocks.
  virtual std::optional<KeyEvent> read() noexcept = 0;

  /// With an IO thread: publishes what was pressed, as much as the queue has room for. The rest waits where
  /// it is, so that no key press is lost however fast they come.
  void receive(const Tick& tick) noexcept override {
    now_ = tick.now;
    constexpr int most_keys_per_cycle =
        64;  // a reader as fast as the writer must not hold this thread for ever
    for (int n = 0; n < most_keys_per_cycle && keys.is_connected() && keys.has_room(); ++n) {
      const std::optional<KeyEvent> event = read();
      if (!event) break;
      keys.push(*event, tick.now);
    }
  }

 protected:
  /// As of the last receive(); 0 before the first.
  Time now() const noexcept { return now_; }

 private:
  Time now_{};
};

}  // namespace flexrf
