#pragma once

#include "tally_unit.hpp"

class Tally final : public flexrf::user::TallyUnit {
 public:
  void step(const flexrf::Tick& /*tick*/) override { ++feedback.steps; }
};
