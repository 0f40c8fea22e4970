// What every driver of Pointer must do. A driver's test makes a world, which is the driver and the hand that
// moves the pointer, and runs the cases in it.
#pragma once

#include <cstddef>
#include <memory>

#include "hal/operator/conformance/hand_device_world.hpp"
#include "hal/operator/pointer/interface/pointer.hpp"

namespace flexrf {

class PointerWorld : public HandDeviceWorld<Pointer, PointerFeedback> {
 public:
  virtual void move(int x, int y) = 0;
  virtual void turn_wheel(int detents) = 0;
};

using MakePointerWorld = std::unique_ptr<PointerWorld> (*)();

/// Runs all cases, each in a world of its own; returns the number that failed, for main().
int run_pointer_conformance(const char* driver, MakePointerWorld make);

}  // namespace flexrf
