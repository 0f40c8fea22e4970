#pragma once

#include "benchmarks/panel_load/recording.hpp"
#include "probe_unit.hpp"

namespace flexrf::user {

class Probe final : public ProbeUnit {
 public:
  Status initialise() override {
    const Result<Recording*> recording = open_recording();
    if (!recording) return recording.status();
    recording_ = *recording;
    return {};
  }
  void step(const Tick& tick) override {
    recording_->steps.fetch_add(1, std::memory_order_relaxed);
    const std::uint64_t release = recording_->releases.load(std::memory_order_relaxed);
    if (release == Recording::most_releases) return;
    recording_->lateness[release] = tick.lateness.count();
    recording_->releases.store(release + 1, std::memory_order_release);
  }

 private:
  Recording* recording_ = nullptr;
};

}  // namespace flexrf::user
