#pragma once

#include "fetcher_unit.hpp"

namespace flexrf::user {

class Fetcher final : public FetcherUnit {
 public:
  void reset() noexcept override { efforts_ = {}; }
  void step(const Tick& /*tick*/) override {
    if (runtime.rests) return;
    for (int fetched = 0; fetched < 4; ++fetched) {
      const auto errand = errands.pop();
      if (!errand) return;
      efforts_.last[efforts_.count % efforts_.last.size()] = {errand->number, Mood::fresh};
      ++efforts_.count;
      effort.publish(efforts_);
    }
  }

 private:
  Efforts efforts_{};
};

}  // namespace flexrf::user
