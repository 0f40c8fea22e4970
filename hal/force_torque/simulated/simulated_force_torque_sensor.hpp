// SimulatedForceTorqueSensor: speaks RDT with a model of a sensor, without a network.
#pragma once

#include <algorithm>

#include "hal/force_torque/interface/measuring_driver.hpp"
#include "hal/force_torque/net_ft/net_ft_session.hpp"
#include "hal/force_torque/net_ft/simulator/net_ft_model.hpp"
#include "simulated_force_torque_sensor_driver.hpp"

namespace flexrf {

class SimulatedForceTorqueSensor final : public MeasuringDriver<SimulatedForceTorqueSensorDriver> {
 public:
  Status initialise() override;
  Time next_event() const noexcept override {
    if (now_ == Time{}) return Time{};
    return std::min(model_.next(), now_ + asking_interval);
  }

  /// For tests, between cycles, from initialise() on: what loads it and what goes wrong.
  NetFtModel& model() noexcept { return model_; }

 private:
  void listen(WrenchMeter& meter, Time now) noexcept override;

  /// As the session asks while nothing comes.
  static constexpr Duration asking_interval = std::chrono::milliseconds(100);

  NetFtModel model_;
  NetFtSession session_;
  Time now_{};  // of the last cycle
};

}  // namespace flexrf
