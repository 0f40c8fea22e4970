#pragma once

#include "benchmarks/panel_load/recording.hpp"
#include "mover_unit.hpp"

namespace flexrf::user {

class Mover final : public MoverUnit {
 public:
  Status initialise() override {
    const Result<Recording*> recording = open_recording();
    if (!recording) return recording.status();
    recording_ = *recording;
    return {};
  }
  void step(const Tick& tick) override {
    const bool moves = (runtime.forward || runtime.run) && !tick.motion_inhibited && !tick.stop_requested;
    const double commanded = moves ? 1 : 0;
    const std::int64_t now = tick.now.time_since_epoch().count();
    if (commanded > feedback.commanded) recording_->began_at.store(now, std::memory_order_release);
    if (commanded < feedback.commanded) recording_->fell_at.store(now, std::memory_order_release);
    feedback.commanded = commanded;
  }

 private:
  Recording* recording_ = nullptr;
};

}  // namespace flexrf::user
