#include "hal/force_torque/simulated/simulated_force_torque_sensor.hpp"

namespace flexrf {

Status SimulatedForceTorqueSensor::initialise() {
  if (Status status = begin_measuring(); !status) return status;
  now_ = Time{};
  model_ = NetFtModel(configuration.rate);
  model_.set_load(configuration.load_force, configuration.load_torque);
  return session_.begin({NetFtModel::counts_per_force, NetFtModel::counts_per_torque, AtiFamily::axia});
}

void SimulatedForceTorqueSensor::listen(WrenchMeter& meter, Time now) noexcept {
  now_ = now;
  while (const auto datagram = model_.send(now)) {
    if (datagram->foreign) {
      meter.note_foreign();
    } else {
      session_.take(datagram->view(), now, meter);
    }
  }
  if (const auto request = session_.request(now)) model_.receive(*request, now);
}

}  // namespace flexrf
