#pragma once

#include "relay_unit.hpp"

namespace flexrf::user {

class Relay final : public RelayUnit {
 public:
  void step(const Tick&) override {
    const auto seen = before.latest();
    after.publish({seen ? seen->value + 1 : 1});
    ++feedback.steps;
  }
};

}  // namespace flexrf::user
