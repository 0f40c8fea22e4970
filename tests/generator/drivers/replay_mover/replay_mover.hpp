#pragma once

#include "replay_mover_driver.hpp"

namespace flexrf::user {

class ReplayMover final : public ReplayMoverDriver {
 public:
  void go(double /*x*/) noexcept override {}
  void receive(const Tick& /*tick*/) noexcept override {
    if (scene.latest().is_new()) ++feedback.scenes;
    place.publish({++number_, -1.0});
  }

 private:
  std::uint32_t number_ = 0;
};

}  // namespace flexrf::user
