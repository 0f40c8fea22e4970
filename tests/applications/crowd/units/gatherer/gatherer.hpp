#pragma once

#include "gatherer_unit.hpp"

namespace flexrf::user {

class Gatherer final : public GathererUnit {
 public:
  void step(const Tick& tick) override;
};

}  // namespace flexrf::user
