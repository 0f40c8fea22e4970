#pragma once

#include "fence_unit.hpp"

namespace flexrf::user {

class Fence final : public FenceUnit {
 public:
  void step(const Tick&) override {
    const auto pose = wanted.latest();
    if (!pose) return;  // nothing in, nothing out: who reads us sees the item grow old
    Pose lifted = *pose;
    feedback.lifted = lifted.position[2] < runtime.lowest;
    if (feedback.lifted) lifted.position[2] = runtime.lowest;
    allowed.publish(lifted, pose.sampled_at());
  }
};

}  // namespace flexrf::user
