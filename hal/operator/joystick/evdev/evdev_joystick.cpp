#include "hal/operator/joystick/evdev/evdev_joystick.hpp"

namespace flexrf {

Status EvdevJoystick::initialise() {
  tracker_ = {};
  feedback = {};
  return port_.begin({.owner = name(),
                      .device = std::string(configuration.device_view()),
                      .grab = configuration.grab,
                      .kind = EvdevKind::joystick});
}

void EvdevJoystick::receive(const Tick& tick) noexcept {
  if (const EvdevDevice* const device = port_.begin_cycle(); device != nullptr) {
    tracker_.appear();
    layout_ = JoystickLayout(*device);
  }
  input_event event{};
  while (port_.next(event)) take(event);
  if (!port_.is_present()) tracker_.vanish();
  feedback.present = port_.is_present();
  feedback.losses = port_.losses();
  feedback.overflows = port_.overflows();
  stick.publish(tracker_.state(), tick.now);
}

void EvdevJoystick::take(const input_event& event) noexcept {
  if (event.type == EV_ABS) {
    const std::size_t axis = layout_.axis(event.code);
    if (axis != JoystickLayout::none)
      tracker_.deflect(axis, deflection(event.value, layout_.range(axis), configuration.dead_zone));
  } else if (event.type == EV_KEY) {
    const std::size_t button = layout_.button(event.code);
    event.value != 0 ? tracker_.press(button) : tracker_.let_go(button);
  }
}

}  // namespace flexrf
