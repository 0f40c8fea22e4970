#include "hal/modbus/link/simulated/simulated_modbus_link.hpp"

namespace flexrf {

Status SimulatedModbusLink::initialise() {
  started_ = Time{};
  cut_ = false;
  registers_.set_fault(ModbusWireFault::none);
  registers_.configure(duration_of(configuration.delay), duration_of(configuration.response_timeout));
  return master().start(
      name(), registers_,
      {duration_of(configuration.reconnect_shortest), duration_of(configuration.reconnect_longest)},
      environment().longest_step);
}

Result<ModbusExchange*> SimulatedModbusLink::attach(const ModbusStationSetup& setup) {
  registers_.add(setup.unit_id, *setup.map);
  return SimulatedModbusLinkDriver::attach(setup);
}

void SimulatedModbusLink::receive(const Tick& tick) noexcept {
  if (started_ == Time{}) started_ = tick.now;
  inject_scheduled(tick.now);
  if (registers_.advance(tick.now)) SimulatedModbusLinkDriver::receive(tick);
}

void SimulatedModbusLink::inject_scheduled(Time now) noexcept {
  if (configuration.fault_after <= 0) return;
  const double since = seconds(now - started_) - configuration.fault_after;
  const bool cut = since >= 0 && since < configuration.fault_lasts;
  if (cut == cut_) return;
  cut_ = cut;
  registers_.set_fault(cut ? ModbusWireFault::disconnected : ModbusWireFault::none);
}

}  // namespace flexrf
