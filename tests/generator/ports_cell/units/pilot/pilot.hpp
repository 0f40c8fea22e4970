#pragma once

#include "pilot_unit.hpp"

namespace flexrf::user {

class Pilot final : public PilotUnit {
 public:
  void step(const Tick& tick) override { mover->go(static_cast<double>(tick.number)); }
};

}  // namespace flexrf::user
