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
    errands.push({runtime.pace + 0.25 * (number % 5), number});
  }

 private:
  Efforts efforts_{};
};

}  // namespace flexrf::user
