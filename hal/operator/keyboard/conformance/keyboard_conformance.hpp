// What every driver of Keyboard must do. A driver's test makes a world, which is the driver and whoever
// presses its keys, and runs the cases in it.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "hal/driver/device_bench.hpp"
#include "hal/operator/keyboard/interface/keyboard.hpp"

namespace flexrf {

class KeyboardWorld {
 public:
  virtual ~KeyboardWorld() = default;

  /// Before start(): the keys that will be pressed, all at once; and whether the input ends after them.
  virtual void will_press(std::span<const KeyEvent> events, bool then_ends) = 0;
  /// Initialises the driver, whose output goes to `sinks` (empty: not connected).
  virtual Status start(std::span<QueueSink* const> sinks) = 0;
  virtual Keyboard& keyboard() = 0;
  /// The thread's cycle.
  virtual void receive() = 0;
  /// Whether this keyboard has keys that write no character.
  virtual bool has_arrows() const { return true; }
  /// Whether there can be a last key.
  virtual bool can_end() const { return true; }

  // ---- After start(), of a keyboard that knows which keys are down; false: this one does not

  virtual bool hold(const KeyEvent& /*key*/) { return false; }
  virtual bool let_go(const KeyEvent& /*key*/) { return false; }
  virtual bool unplug() { return false; }
  virtual bool plug_in() { return false; }

  // ---- Before start(), false where it cannot be: no such keyboard is there; the user has no right to it;
  // somebody else has it for himself

  virtual bool hide() { return false; }
  virtual bool forbid() { return false; }
  virtual bool occupy() { return false; }
};

using MakeKeyboardWorld = std::unique_ptr<KeyboardWorld> (*)();

/// Runs all cases, each in a world of its own; returns the number that failed, for main().
int run_keyboard_conformance(const char* driver, MakeKeyboardWorld make);

}  // namespace flexrf
