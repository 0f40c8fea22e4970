// Smoothing: follows a level with a first-order lag.
#pragma once

#include "smoothing_unit.hpp"

namespace flexrf::user {

class Smoothing final : public SmoothingUnit {
 public:
  Status initialise() override;
  void step(const Tick& tick) override;

 private:
  double value_ = 0;
};

}  // namespace flexrf::user
