// Joystick: axes that are deflected, and buttons.
#pragma once

#include "joystick_interface.hpp"
#include "types/joystick_state.hpp"

namespace flexrf {

/// Everything: the thread the joystick lives in.
class Joystick : public JoystickInterface {
 public:
  using JoystickInterface::JoystickInterface;

  /// As of the last receive() [joystick-1]. Presses are totals that never go back [joystick-2].
  virtual const JoystickState& state() const noexcept = 0;
};

}  // namespace flexrf
