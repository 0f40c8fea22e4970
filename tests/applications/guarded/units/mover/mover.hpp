#pragma once

#include "mover_unit.hpp"

namespace flexrf::user {

/// Commands in every step, whether it may or not: it is not the unit that keeps the valve shut.
class Mover final : public MoverUnit {
 public:
  void step(const Tick& tick) override { valve->command(!tick.stop_requested); }
};

}  // namespace flexrf::user
