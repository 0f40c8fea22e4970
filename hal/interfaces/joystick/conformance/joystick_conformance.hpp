// What every driver of Joystick must do. A driver's test makes a world, which is the driver and the hand on
// the stick, and runs the cases in it.
#pragma once

#include <cstddef>
#include <memory>

#include "hal/interfaces/joystick/joystick.hpp"
#include "runtime/core/status.hpp"

namespace flexrf {

/// With axes 0 to 3 at least, buttons 0 to 3 at least, and a dead zone of 0.2.
class JoystickWorld {
 public:
  static constexpr double dead_zone = 0.2;
  /// How near an axis can be brought to where the hand wants it.
  static constexpr double resolution = 0.02;

  virtual ~JoystickWorld() = default;

  /// Initialises the driver. The joystick is plugged in unless the world was told otherwise.
  virtual Status start() = 0;
  virtual Joystick& joystick() = 0;
  virtual const JoystickFeedback& feedback() = 0;
  /// The thread's cycle; where a kernel is between hand and driver, it waits a little for something to come.
  virtual void receive() = 0;

  /// To this part of its way from the centre, −1 to 1, with no dead zone taken off.
  virtual void deflect(std::size_t axis, double part) = 0;
  virtual void press(std::size_t button) = 0;
  virtual void let_go(std::size_t button) = 0;
  virtual void unplug() = 0;
  virtual void plug_in() = 0;

  /// Before start(), false where it cannot be: no such joystick is there; the user has no right to it;
  /// somebody else has it for himself.
  virtual bool hide() { return false; }
  virtual bool forbid() { return false; }
  virtual bool occupy() { return false; }
};

using MakeJoystickWorld = std::unique_ptr<JoystickWorld> (*)();

/// Runs all cases, each in a world of its own; returns the number that failed, for main().
int run_joystick_conformance(const char* driver, MakeJoystickWorld make);

}  // namespace flexrf
