#pragma once

namespace flexrf {

/// The conformance suites on devices that uinput makes; each returns how many cases failed.
int run_evdev_keyboard_suite();
int run_evdev_pointer_suite();
int run_evdev_joystick_suite();

}  // namespace flexrf
