#pragma once

#include "relay_unit.hpp"

namespace flexrf::user {

class Relay final : public RelayUnit {
 public:
  void step(const Tick& /*tick*/) override {
    const auto latest = mark.latest();
    if (!latest) return;
    Mark handed_on = *latest;
    handed_on.gain += configuration.place;
    handed_on.check += configuration.place;
    relayed.publish(handed_on);
  }
};

}  // namespace flexrf::user
