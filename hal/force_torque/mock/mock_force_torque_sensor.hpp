// MockForceTorqueSensor: a sensor in memory, with a load, a fault or a silence where a test puts it.
#pragma once

#include "hal/driver/mock/mock_noise.hpp"
#include "hal/force_torque/interface/measuring_driver.hpp"
#include "mock_force_torque_sensor_driver.hpp"

namespace flexrf {

/// Tests call it between cycles, from the thread the sensor lives in.
class MockForceTorqueSensor final : public MeasuringDriver<MockForceTorqueSensorDriver> {
 public:
  Status initialise() override;
  Time next_event() const noexcept override { return due_; }

  // ---- for tests

  /// On the sensor's own axes, from the next measurement on; also whether it says that it is saturated.
  void set_load(const RawWrench& load) noexcept { load_ = load; }
  /// Whether its measurements come.
  void set_silent(bool silent) noexcept { silent_ = silent; }
  /// They come so much later than they were taken.
  void set_delay(Duration delay) noexcept { delay_ = delay; }
  /// What it says in place of measurements; ok: it measures.
  void set_fault(const Status& fault) noexcept { fault_ = fault; }
  /// So many of the next do not come.
  void lose(std::uint64_t count) noexcept { to_lose_ = count; }
  /// So many of the next come garbled.
  void damage(std::uint64_t count) noexcept { to_damage_ = count; }

 private:
  void listen(WrenchMeter& meter, Time now) noexcept override;
  void measure(WrenchMeter& meter, Time at) noexcept;

  RawWrench load_;
  Status fault_;
  bool silent_ = false;
  Duration delay_{};
  std::uint64_t to_lose_ = 0;
  std::uint64_t to_damage_ = 0;
  std::uint64_t missed_ = 0;  // since the last that came
  MockNoise noise_;
  Time due_{};
};

}  // namespace flexrf
