#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>

#include "hal/operator/evdev/evdev_device.hpp"
#include "hal/operator/joystick/interface/joystick_tracker.hpp"

namespace flexrf {

/// Which number the axes and buttons of a device have: in the order of the kernel's codes, buttons of
/// joysticks and gamepads first, as jstest counts them.
class JoystickLayout {
 public:
  static constexpr std::size_t none = 255;

  JoystickLayout() noexcept {
    axes_.fill(none);
    buttons_.fill(none);
  }
  /// Neither blocks nor allocates.
  explicit JoystickLayout(const EvdevDevice& device) noexcept : JoystickLayout() {
    for (unsigned code = 0; code < ABS_CNT; ++code) {
      const input_absinfo* const axis = device.axis(code);
      if (axis == nullptr || axis_count_ == ranges_.size()) continue;
      ranges_[axis_count_] = {static_cast<double>(axis->minimum), static_cast<double>(axis->maximum),
                              static_cast<double>(axis->flat)};
      axes_[code] = static_cast<std::uint8_t>(axis_count_++);
    }
    for (unsigned code = BTN_JOYSTICK; code < KEY_CNT; ++code) number_button(device, code);
    for (unsigned code = BTN_MISC; code < BTN_JOYSTICK; ++code) number_button(device, code);
  }

  std::size_t axis(unsigned code) const noexcept { return code < axes_.size() ? axes_[code] : none; }
  std::size_t button(unsigned code) const noexcept { return code < buttons_.size() ? buttons_[code] : none; }
  /// Of an axis that has a number.
  const JoystickRange& range(std::size_t axis) const noexcept { return ranges_[axis]; }

 private:
  void number_button(const EvdevDevice& device, unsigned code) noexcept {
    if (button_count_ < none && device.has(EV_KEY, code))
      buttons_[code] = static_cast<std::uint8_t>(button_count_++);
  }

  std::array<std::uint8_t, ABS_CNT> axes_{};
  std::array<std::uint8_t, KEY_CNT> buttons_{};
  std::array<JoystickRange, std::tuple_size_v<decltype(JoystickState::axes)>> ranges_{};
  std::size_t axis_count_ = 0;
  std::size_t button_count_ = 0;
};

}  // namespace flexrf
