// TerminalKeyboard: the keys of the terminal on standard input, or its bytes when it is a pipe or a file.
#pragma once

#include "hal/interfaces/keyboard/keyboard.hpp"
#include "hal/linux/terminal_keyboard/key_decoder.hpp"
#include "terminal_keyboard_driver.hpp"

namespace flexrf {

/// On a terminal, Ctrl-D closes it. Elsewhere the end of the input does, and newlines are no keys.
class TerminalKeyboard final : public TerminalKeyboardDriver {
 public:
  ~TerminalKeyboard() override;

  Status initialise() override;
  void stop() override;

  std::optional<KeyEvent> read() noexcept override;
  bool is_closed() const noexcept override { return ended_ && !decoder_.has_event(); }
  int descriptor() const noexcept override { return wait_; }

 private:
  void take_byte(std::uint8_t byte) noexcept;
  bool read_byte(std::uint8_t& byte) noexcept;
  void await_rest_of_sequence(bool on) noexcept;
  bool has_waited() noexcept;

  KeyDecoder decoder_;
  bool terminal_ = false;
  bool ended_ = false;
  bool waiting_ = false;  // for the rest of an escape sequence
  int timer_ = -1;
  int wait_ = -1;      // readable when standard input or the timer is
  int own_wait_ = -1;  // the same, when it is ours to close
};

}  // namespace flexrf
