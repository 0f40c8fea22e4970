#pragma once

#include "still_mover_driver.hpp"

namespace flexrf::user {

class StillMover final : public StillMoverDriver {
 public:
  void go(double /*x*/) noexcept override {}
};

}  // namespace flexrf::user
