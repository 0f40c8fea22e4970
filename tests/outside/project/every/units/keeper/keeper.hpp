#pragma once

#include "keeper_unit.hpp"

namespace flexrf::user {

class Keeper final : public KeeperUnit {
 public:
  void step(const Tick& /*tick*/) override {
    while (presses.pop()) {
    }
    ++feedback.steps;
  }
};

}  // namespace flexrf::user
