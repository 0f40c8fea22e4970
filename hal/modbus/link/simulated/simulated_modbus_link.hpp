// SimulatedModbusLink: stations that are registers in memory, behind a link that can fail.
#pragma once

#include "hal/modbus/link/simulated/simulated_registers.hpp"
#include "simulated_modbus_link_driver.hpp"

namespace flexrf {

/// Has the registers of every station that is on it, all 0 at first; what is written stays, and is what a
/// register that is read too then tells.
class SimulatedModbusLink final : public SimulatedModbusLinkDriver {
 public:
  Status initialise() override;
  void stop() override { master().stop(); }
  void receive(const Tick& tick) noexcept override;
  Result<ModbusExchange*> attach(const ModbusStationSetup& setup) override;

  /// For models of what the stations do, and for tests: the link's thread.
  SimulatedRegisters& registers() noexcept { return registers_; }

 private:
  void inject_scheduled(Time now) noexcept;

  SimulatedRegisters registers_;
  Time started_{};
  bool cut_ = false;
};

}  // namespace flexrf
