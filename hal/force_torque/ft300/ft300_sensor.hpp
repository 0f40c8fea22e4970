// Ft300Sensor: a force-torque sensor FT300 or FT300-S of Robotiq.
#pragma once

#include "ft300_sensor_driver.hpp"
#include "hal/force_torque/ft300/ft300_line.hpp"
#include "hal/force_torque/interface/measuring_driver.hpp"

namespace flexrf {

class Ft300Sensor final : public MeasuringDriver<Ft300SensorDriver> {
 public:
  Status initialise() override;
  void stop() override { line_.stop(); }
  int descriptor() const noexcept override { return line_.descriptor(); }

 private:
  void listen(WrenchMeter& meter, Time now) noexcept override;

  Ft300Line line_;
  std::uint64_t frames_ = 0;
  std::uint64_t damaged_ = 0;
};

}  // namespace flexrf
