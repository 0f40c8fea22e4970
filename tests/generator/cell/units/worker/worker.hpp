#pragma once

#include "worker_unit.hpp"

namespace flexrf::user {

class Worker final : public WorkerUnit {
 public:
  void step(const Tick& /*tick*/) override {
    if (const auto job = jobs.pop()) place.publish({static_cast<double>(job->number), true});
  }
};

}  // namespace flexrf::user
