// What the worlds of Pointer and of Joystick have in common: something with buttons, which a hand moves,
// presses and unplugs.
#pragma once

#include <cstddef>

#include "base/status.hpp"

namespace flexrf {

/// A driver of `DeviceInterface` and the hand on the device.
template <class DeviceInterface, class DeviceFeedback>
class HandDeviceWorld {
 public:
  virtual ~HandDeviceWorld() = default;

  /// Initialises the driver. The device is plugged in unless the world was told otherwise.
  virtual Status start() = 0;
  virtual DeviceInterface& device() = 0;
  virtual const DeviceFeedback& feedback() = 0;
  /// The thread's cycle; where a kernel is between hand and driver, it waits a little for something to come.
  virtual void receive() = 0;

  virtual void press(std::size_t button) = 0;
  virtual void let_go(std::size_t button) = 0;
  virtual void unplug() = 0;
  virtual void plug_in() = 0;

  /// Before start(), false where it cannot be: no such device is there; the user has no right to it; somebody
  /// else has it for himself.
  virtual bool hide() { return false; }
  virtual bool forbid() { return false; }
  virtual bool occupy() { return false; }
};

}  // namespace flexrf
