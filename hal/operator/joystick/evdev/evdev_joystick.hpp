// EvdevJoystick: a joystick or gamepad of the machine, through the kernel's input layer.
#pragma once

#include "evdev_joystick_driver.hpp"
#include "hal/operator/evdev/evdev_port.hpp"
#include "hal/operator/joystick/evdev/joystick_layout.hpp"
#include "hal/operator/joystick/interface/joystick_tracker.hpp"

namespace flexrf {

class EvdevJoystick final : public EvdevJoystickDriver {
 public:
  Status initialise() override;
  void stop() override { port_.end(); }
  void receive(const Tick& tick) noexcept override;

  const JoystickState& state() const noexcept override { return tracker_.state(); }
  int descriptor() const noexcept override { return port_.descriptor(); }

 private:
  void take(const input_event& event) noexcept;

  EvdevPort port_;
  JoystickTracker tracker_;
  JoystickLayout layout_;
};

}  // namespace flexrf
