#include "hal/operator/keyboard/evdev/evdev_keyboard.hpp"

#include "hal/operator/keyboard/evdev/evdev_keys.hpp"

namespace flexrf {

Status EvdevKeyboard::initialise() {
  tracker_ = {};
  pressed_ = taken_ = 0;
  return port_.begin({.owner = name(),
                      .device = std::string(configuration.device_view()),
                      .grab = configuration.grab,
                      .kind = EvdevKind::keyboard});
}

void EvdevKeyboard::receive(const Tick& tick) noexcept {
  if (port_.begin_cycle() != nullptr) {
    tracker_.appear();
    left_shift_ = right_shift_ = false;
  }
  input_event event{};
  while (port_.next(event)) {
    constexpr int repeated = 2;
    if (event.type == EV_KEY && event.value != repeated) take(event.code, event.value != 0);
  }
  if (!port_.is_present()) tracker_.vanish();
  EvdevKeyboardDriver::receive(tick);
}

void EvdevKeyboard::take(unsigned code, bool down) noexcept {
  if (code == KEY_LEFTSHIFT) left_shift_ = down;
  if (code == KEY_RIGHTSHIFT) right_shift_ = down;
  const KeyEvent plain = key_of_code(code, false);
  if (plain.key == Key::none) return;
  if (!down) return tracker_.let_go(plain);
  tracker_.press(plain);
  if (pressed_ - taken_ < capacity)
    presses_[pressed_++ % capacity] = key_of_code(code, left_shift_ || right_shift_);
}

std::optional<KeyEvent> EvdevKeyboard::read() noexcept {
  if (taken_ == pressed_) return std::nullopt;
  return presses_[taken_++ % capacity];
}

}  // namespace flexrf
