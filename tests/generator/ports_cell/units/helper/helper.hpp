#pragma once

#include "helper_unit.hpp"

namespace flexrf::user {

class Helper final : public HelperUnit {
 public:
  void step(const Tick& /*tick*/) override {
    if (truth.latest().is_new()) ++feedback.steps;
  }
};

}  // namespace flexrf::user
