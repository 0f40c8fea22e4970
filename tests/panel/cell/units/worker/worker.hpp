#pragma once

#include "worker_unit.hpp"

namespace flexrf::user {

class Worker final : public WorkerUnit {
 public:
  void reset() noexcept override { feedback.done = 0; }
  void step(const Tick& /*tick*/) override {
    const auto task = tasks.pop();
    if (!task) return;
    ++feedback.done;
    spot.publish({runtime.pace * task->number, true});
  }
};

}  // namespace flexrf::user
