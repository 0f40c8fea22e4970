#pragma once

#include "lift_unit.hpp"

class Lift final : public flexrf::user::LiftUnit {  // outside of the namespace, as an author may like
 public:
  void step(const flexrf::Tick& /*tick*/) override {}
};
