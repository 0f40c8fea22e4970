// TerminalKeyboard: the keys of the terminal on standard input, or its bytes when it is a pipe or a file.
#pragma once

#include "hal/operator/keyboard/interface/keyboard.hpp"
#include "hal/operator/keyboard/terminal/key_decoder.hpp"
#include "terminal_keyboard_driver.hpp"

namespace flexrf {

/// On a terminal, Ctrl-D closes it. Elsewhere the end of the input does, and newlines are no keys.
class TerminalKeyboard final : public TerminalKeyboardDriver {
 public:
  ~TerminalKeyboard() override;

  Status initialise() override;
  void stop() override;
  void receive(const Tick& tick) noexcept override;

  std::optional<KeyEvent> read() noexcept override;
  bool is_closed() const noexcept override { return ended_ && !decoder_.has_event(); }
  /// Readable when there is a key to read; now and then, when there is no room for one or the input has
  /// ended.
  int descriptor() const noexcept override { return rests_ ? timer_ : wait_; }

 private:
  void take_byte(std::uint8_t byte) noexcept;
  bool read_byte(std::uint8_t& byte) noexcept;
  void await_rest_of_sequence(bool on) noexcept;
  bool has_waited() noexcept;
  void set_timer(Duration after) noexcept;

  KeyDecoder decoder_;
  bool terminal_ = false;
  bool ended_ = false;
  bool away_ = false;     // in the background
  bool waiting_ = false;  // for the rest of an escape sequence
  bool rests_ = false;    // standard input, readable all the time, is not watched
  int bytes_left_ = 0;    // that this cycle may still read
  int events_ = 0;        // key presses in this cycle
  int timer_ = -1;
  int wait_ = -1;      // readable when standard input or the timer is
  int own_wait_ = -1;  // the same, when it is ours to close
};

}  // namespace flexrf
