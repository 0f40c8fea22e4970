#pragma once

#include "mover_unit.hpp"

namespace flexrf::user {

class Mover final : public MoverUnit {
 public:
  void step(const Tick& tick) override {
    double wanted = 0;
    if (runtime.forward != runtime.backward) wanted = runtime.forward ? runtime.speed : -runtime.speed;
    if (runtime.run) wanted = runtime.speed;
    if (tick.motion_inhibited || tick.stop_requested) wanted = 0;
    if (wanted != 0 && feedback.commanded == 0) ++feedback.begun;
    if (wanted == 0 && feedback.commanded != 0) feedback.ended_at = tick.now.time_since_epoch().count();
    feedback.commanded = wanted * configuration.ratio;
    axle->command(feedback.commanded);
  }
  bool is_idle() const noexcept override { return axle->speed() == 0; }
};

}  // namespace flexrf::user
