#pragma once

#include "overview_unit.hpp"

namespace flexrf::user {

class Overview final : public OverviewUnit {
 public:
  void step(const Tick& tick) override {
    feedback.seen = 0;
    for (auto& place : places) feedback.seen += place.latest() ? 1U : 0U;
    Everything before;
    if (sample.at(tick.now - std::chrono::milliseconds(10), before) == NullReason::none) {
      feedback.past = before.number;
    }
    if (kept.latest()) kept.keep();
    if (missing.latest() || station->output() < 0) fail(Status::error(StatusCode::internal, "not possible"));
  }
};

}  // namespace flexrf::user
