#pragma once

#include "fragile_unit.hpp"

namespace flexrf::user {

class Fragile final : public FragileUnit {
 public:
  void step(const Tick& /*tick*/) override {
    static_cast<void>(sample.latest());
    for (auto& spot : spots) static_cast<void>(spot.latest());
    feedback.whole = runtime.drop == 0;
    if (!feedback.whole) fail(Status::error(StatusCode::device_fault, "it was dropped"));
  }
};

}  // namespace flexrf::user
