#include "hal/force_torque/mock/mock_force_torque_sensor.hpp"

namespace flexrf {

Status MockForceTorqueSensor::initialise() {
  due_ = Time{};
  missed_ = 0;
  noise_.seed(environment().seed);
  return begin_measuring();
}

void MockForceTorqueSensor::listen(WrenchMeter& meter, Time now) noexcept {
  const Duration period = duration_of(1.0 / configuration.rate);
  if (due_ == Time{}) due_ = now;
  while (due_ + delay_ <= now) {
    measure(meter, due_ + delay_);
    due_ += period;
  }
}

void MockForceTorqueSensor::measure(WrenchMeter& meter, Time at) noexcept {
  if (silent_) return;
  if (to_lose_ > 0) {
    --to_lose_;
    ++missed_;
    return;
  }
  if (to_damage_ > 0) {
    --to_damage_;
    ++missed_;
    return meter.note_damaged();
  }
  if (!fault_.is_ok()) return meter.take_fault(fault_, at);
  RawWrench raw = load_;
  for (double& force : raw.force) force += noise_.around_zero(configuration.force_noise);
  for (double& torque : raw.torque) torque += noise_.around_zero(configuration.torque_noise);
  meter.take(raw, at, missed_);
  missed_ = 0;
}

}  // namespace flexrf
