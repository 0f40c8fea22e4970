// MeasuringDriver: a driver of ForceTorqueSensor over a generated base. What differs between drivers is how
// measurements come.
#pragma once

#include <chrono>

#include "hal/driver/trouble_log.hpp"
#include "hal/force_torque/interface/wrench_meter.hpp"

namespace flexrf {

template <class Base>
class MeasuringDriver : public Base {
 public:
  void receive(const Tick& tick) noexcept override {
    listen(meter_, tick.now);
    meter_.close(tick.now);
    log_.look(this->name(), meter_.trouble(), tick.now);
    if (this->runtime.clear_tare > 0) meter_.clear_tare();
    if (this->runtime.tare > 0) meter_.tare();
    meter_.fill(this->feedback);
    const std::optional<Wrench>& state = meter_.state();
    if (!state || state->sequence == published_) return;
    published_ = state->sequence;
    this->wrench.publish(*state, Time{Duration{state->time}});
  }

  std::optional<Wrench> state() const noexcept override { return meter_.state(); }
  Duration age() const noexcept override { return meter_.age(); }
  const Status& trouble() const noexcept override { return meter_.trouble(); }
  void tare() noexcept override { meter_.tare(); }
  void clear_tare() noexcept override { meter_.clear_tare(); }
  bool is_taring() const noexcept override { return meter_.is_taring(); }

 protected:
  /// To be called by initialise().
  Status begin_measuring() noexcept {
    const auto& set = this->configuration;
    published_ = 0;
    return meter_.begin(this->name(),
                        {set.position, set.orientation, set.force_limit, set.torque_limit, set.tare_samples,
                         duration_of(set.max_age), duration_of(set.frozen_after)});
  }

  /// Takes in what came since the cycle before.
  virtual void listen(WrenchMeter& meter, Time now) noexcept = 0;

 private:
  WrenchMeter meter_;
  TroubleLog log_;
  std::uint64_t published_ = 0;
};

}  // namespace flexrf
