// What every driver of Joystick must do. A driver's test makes a world, which is the driver and the hand on
// the stick, and runs the cases in it.
#pragma once

#include <cstddef>
#include <memory>

#include "hal/operator/conformance/hand_device_world.hpp"
#include "hal/operator/joystick/interface/joystick.hpp"

namespace flexrf {

/// With axes 0 to 3 at least, buttons 0 to 3 at least, and a dead zone of 0.2.
class JoystickWorld : public HandDeviceWorld<Joystick, JoystickFeedback> {
 public:
  static constexpr double dead_zone = 0.2;
  /// How near an axis can be brought to where the hand wants it.
  static constexpr double resolution = 0.02;

  /// To this part of its way from the centre, −1 to 1, with no dead zone taken off.
  virtual void deflect(std::size_t axis, double part) = 0;
};

using MakeJoystickWorld = std::unique_ptr<JoystickWorld> (*)();

/// Runs all cases, each in a world of its own; returns the number that failed, for main().
int run_joystick_conformance(const char* driver, MakeJoystickWorld make);

}  // namespace flexrf
