// ScriptKeyboard: key presses from a file, each at its time after the keyboard's first cycle.
#pragma once

#include <vector>

#include "hal/operator/keyboard/interface/keyboard.hpp"
#include "hal/operator/keyboard/script/key_script.hpp"
#include "script_keyboard_driver.hpp"

namespace flexrf {

class ScriptKeyboard final : public ScriptKeyboardDriver {
 public:
  ~ScriptKeyboard() override;

  Status initialise() override;
  void stop() override;
  void receive(const Tick& tick) noexcept override;

  std::optional<KeyEvent> read() noexcept override;
  bool is_closed() const noexcept override { return next_ == keys_.size(); }
  /// Readable when the next key is due, but in virtual time.
  int descriptor() const noexcept override { return timer_; }
  Time next_event() const noexcept override;

 private:
  void arm_timer(Time when) noexcept;

  std::vector<ScriptedKey> keys_;
  std::size_t next_ = 0;
  Time started_{};
  int timer_ = -1;
};

}  // namespace flexrf
