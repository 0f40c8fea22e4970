#pragma once

#include "gatherer_unit.hpp"

namespace flexrf {

class Gatherer final : public GathererUnit {
 public:
  void step(const Tick& tick) override;
};

}  // namespace flexrf
