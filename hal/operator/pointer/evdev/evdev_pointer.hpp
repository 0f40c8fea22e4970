// EvdevPointer: a mouse or trackball of the machine, through the kernel's input layer.
#pragma once

#include "evdev_pointer_driver.hpp"
#include "hal/operator/evdev/evdev_port.hpp"
#include "hal/operator/pointer/interface/pointer_tracker.hpp"

namespace flexrf {

class EvdevPointer final : public EvdevPointerDriver {
 public:
  Status initialise() override;
  void stop() override { port_.end(); }
  void receive(const Tick& tick) noexcept override;

  const PointerState& state() const noexcept override { return tracker_.state(); }
  int descriptor() const noexcept override { return port_.descriptor(); }

 private:
  void move(unsigned code, std::int64_t value) noexcept;

  EvdevPort port_;
  PointerTracker tracker_;
  // Finer than detents, where the mouse tells: its detents are then left out.
  bool fine_wheel_ = false;
  bool fine_tilt_ = false;
};

}  // namespace flexrf
