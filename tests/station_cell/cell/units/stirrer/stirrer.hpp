#pragma once

#include <algorithm>

#include "stirrer_unit.hpp"

namespace flexrf::user {

class Stirrer final : public StirrerUnit {
 public:
  Status initialise() override {
    const auto told = station->input("speed");
    const auto set = station->output("speed");
    if (!told) return told.status();
    if (!set) return set.status();
    told_ = *told;
    set_ = *set;
    return {};
  }
  void step(const Tick& tick) override {
    const ModbusValue speed = station->read(told_);
    if (speed) {
      feedback.greatest_speed = std::max(feedback.greatest_speed, speed.value);
      ++feedback.valid;
      if (feedback.gaps > feedback.recoveries) ++feedback.recoveries;
    } else if (feedback.valid > 0 && feedback.gaps == feedback.recoveries) {
      ++feedback.gaps;
    }
    station->set(set_, tick.stop_requested ? 0 : 1.5);
  }

 private:
  std::size_t told_ = 0;
  std::size_t set_ = 0;
};

}  // namespace flexrf::user
