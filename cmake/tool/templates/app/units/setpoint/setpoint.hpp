// Setpoint: publishes the level that the operator sets.
#pragma once

#include "setpoint_unit.hpp"

namespace flexrf::user {

class Setpoint final : public SetpointUnit {
 public:
  void step(const Tick& /*tick*/) override { level.publish({runtime.value}); }
};

}  // namespace flexrf::user
