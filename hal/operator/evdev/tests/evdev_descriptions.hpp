#pragma once

#include "hal/operator/evdev/tests/uinput_device.hpp"

namespace flexrf {

inline UinputDescription keyboard_description() {
  UinputDescription keyboard{.name = "flexrf test keyboard"};
  for (int code = KEY_ESC; code <= KEY_DELETE; ++code) keyboard.keys.push_back(code);
  return keyboard;
}

inline UinputDescription pointer_description() {
  return {.name = "flexrf test mouse",
          .keys = {BTN_LEFT, BTN_RIGHT, BTN_MIDDLE},
          .relative_axes = {REL_X, REL_Y, REL_WHEEL}};
}

/// With ranges as they are found.
inline UinputDescription joystick_description() {
  return {.name = "flexrf test joystick",
          .keys = {BTN_TRIGGER, BTN_THUMB, BTN_THUMB2, BTN_TOP},
          .axes = {{ABS_X, 0, 255}, {ABS_Y, -32768, 32767}, {ABS_Z, 0, 1023}, {ABS_RX, -127, 127}}};
}

}  // namespace flexrf
