#pragma once

#include "pulse_unit.hpp"

namespace flexrf::user {

class Pulse final : public PulseUnit {
 public:
  void step(const Tick& tick) override { beat.publish({tick.number}); }
};

}  // namespace flexrf::user
