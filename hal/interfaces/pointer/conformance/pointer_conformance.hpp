// What every driver of Pointer must do. A driver's test makes a world, which is the driver and the hand that
// moves the pointer, and runs the cases in it.
#pragma once

#include <cstddef>
#include <memory>

#include "hal/interfaces/pointer/pointer.hpp"
#include "runtime/core/status.hpp"

namespace flexrf {

class PointerWorld {
 public:
  virtual ~PointerWorld() = default;

  /// Initialises the driver. The pointer is plugged in unless the world was told otherwise.
  virtual Status start() = 0;
  virtual Pointer& pointer() = 0;
  virtual const PointerFeedback& feedback() = 0;
  /// The thread's cycle; where a kernel is between hand and driver, it waits a little for something to come.
  virtual void receive() = 0;

  virtual void move(int x, int y) = 0;
  virtual void turn_wheel(int detents) = 0;
  virtual void press(std::size_t button) = 0;
  virtual void let_go(std::size_t button) = 0;
  virtual void unplug() = 0;
  virtual void plug_in() = 0;

  /// Before start(), false where it cannot be: no such pointer is there; the user has no right to it;
  /// somebody else has it for himself.
  virtual bool hide() { return false; }
  virtual bool forbid() { return false; }
  virtual bool occupy() { return false; }
};

using MakePointerWorld = std::unique_ptr<PointerWorld> (*)();

/// Runs all cases, each in a world of its own; returns the number that failed, for main().
int run_pointer_conformance(const char* driver, MakePointerWorld make);

}  // namespace flexrf
