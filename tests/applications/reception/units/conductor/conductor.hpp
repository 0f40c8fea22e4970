#pragma once

#include <functional>

#include "conductor_unit.hpp"

namespace flexrf::user {

class Conductor final : public ConductorUnit {
 public:
  /// Called in each step. The test's, before the application runs.
  static inline std::function<void(const Tick&)> score;

  void step(const Tick& tick) override {
    if (score) score(tick);
  }
};

}  // namespace flexrf::user
