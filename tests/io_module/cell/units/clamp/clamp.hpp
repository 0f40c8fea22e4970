#pragma once

#include "clamp_unit.hpp"

namespace flexrf::user {

/// Commands in every step, whether it may or not: it is not the unit that keeps the valve shut.
class Clamp final : public ClampUnit {
 public:
  void step(const Tick& tick) override {
    const auto state = button->state();
    feedback.released = state && state->on;
    valve->command(!tick.stop_requested);
  }
};

}  // namespace flexrf::user
