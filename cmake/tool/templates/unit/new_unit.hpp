// NewUnit: passes a pose on, raised by what the operator sets.
#pragma once

#include "new_unit_unit.hpp"

namespace flexrf::user {

class NewUnit final : public NewUnitUnit {
 public:
  void step(const flexrf::Tick& tick) override;
};

}  // namespace flexrf::user
