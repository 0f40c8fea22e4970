#pragma once

#include <cstdint>

#include "runner_unit.hpp"

namespace flexrf::user {

class Runner final : public RunnerUnit {
 public:
  void reset() noexcept override { efforts_ = {}; }
  void step(const Tick& /*tick*/) override {
    const auto now = beat.latest();
    if (!now) return;
    const auto number = static_cast<std::uint32_t>(now->number);
    efforts_.last[efforts_.count % efforts_.last.size()] = {number,
                                                            runtime.pace > 1.5 ? Mood::tired : Mood::fresh};
    ++efforts_.count;
    effort.publish(efforts_);
    // What comes later is more urgent: else a full queue would take no more, and nobody would be woken.
    errands.push({runtime.pace + 0.25 * (number % 5) + 0.01 * number, number});
  }

 private:
  Efforts efforts_{};
};

}  // namespace flexrf::user
