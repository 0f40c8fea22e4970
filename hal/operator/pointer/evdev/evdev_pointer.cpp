#include "hal/operator/pointer/evdev/evdev_pointer.hpp"

namespace flexrf {
namespace {

constexpr std::int64_t detent = 120;

}  // namespace

Status EvdevPointer::initialise() {
  tracker_ = {};
  feedback = {};
  return port_.begin({.owner = name(),
                      .device = std::string(configuration.device_view()),
                      .grab = configuration.grab,
                      .kind = EvdevKind::pointer});
}

void EvdevPointer::receive(const Tick& tick) noexcept {
  if (const EvdevDevice* const device = port_.begin_cycle(); device != nullptr) {
    tracker_.appear();
    fine_wheel_ = device->has(EV_REL, REL_WHEEL_HI_RES);
    fine_tilt_ = device->has(EV_REL, REL_HWHEEL_HI_RES);
  }
  input_event event{};
  while (port_.next(event)) {
    if (event.type == EV_REL) move(event.code, event.value);
    if (event.type != EV_KEY || event.code < BTN_LEFT) continue;
    const std::size_t button = event.code - std::size_t{BTN_LEFT};
    event.value != 0 ? tracker_.press(button) : tracker_.let_go(button);
  }
  if (!port_.is_present()) tracker_.vanish();
  feedback.present = port_.is_present();
  feedback.losses = port_.losses();
  feedback.overflows = port_.overflows();
  motion.publish(tracker_.state(), tick.now);
}

void EvdevPointer::move(unsigned code, std::int64_t value) noexcept {
  switch (code) {
    case REL_X:
      return tracker_.move(value, 0);
    case REL_Y:
      return tracker_.move(0, value);
    case REL_WHEEL_HI_RES:
      return tracker_.turn(value, 0);
    case REL_HWHEEL_HI_RES:
      return tracker_.turn(0, value);
    case REL_WHEEL:
      return fine_wheel_ ? void() : tracker_.turn(value * detent, 0);
    case REL_HWHEEL:
      return fine_tilt_ ? void() : tracker_.turn(0, value * detent);
    default:
      return;
  }
}

}  // namespace flexrf
