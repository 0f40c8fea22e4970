// Pointer: what a hand moves to and fro, with buttons and a wheel.
#pragma once

#include "pointer_interface.hpp"
#include "types/pointer_state.hpp"

namespace flexrf {

/// Everything: the thread the pointer lives in.
class Pointer : public PointerInterface {
 public:
  using PointerInterface::PointerInterface;

  /// As of the last receive() [pointer-1]. Motion and presses are totals that never go back, also when the
  /// pointer was away [pointer-2]: who wants to know what came since takes the difference to what it saw
  /// before.
  virtual const PointerState& state() const noexcept = 0;
};

}  // namespace flexrf
