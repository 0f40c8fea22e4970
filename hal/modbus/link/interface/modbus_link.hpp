// ModbusLink: a master's link, TCP or serial, that carries stations.
#pragma once

#include "hal/modbus/link/interface/modbus_exchange.hpp"
#include "hal/modbus/link/interface/modbus_master.hpp"
#include "modbus_link_interface.hpp"

namespace flexrf {

/// A link that waits for its answers has an IO thread. Between it and a station everything passes through an
/// exchange, so that the station never waits; the same where both live in one thread.
class ModbusLink : public ModbusLinkInterface {
 public:
  using ModbusLinkInterface::ModbusLinkInterface;

  /// A station registers and goes: lifecycle thread, from the station's initialise() and stop().
  virtual Result<ModbusExchange*> attach(const ModbusStationSetup& setup) { return master_.attach(setup); }
  static void detach(ModbusExchange& exchange) noexcept { ModbusMaster::detach(exchange); }

  /// Asks and writes what is due. With a driver that waits: at most as long as one response
  /// timeout [modbus-link-1], or as many answers as there are due requests.
  void receive(const Tick& tick) noexcept override;
  /// True when every station that is written to has confirmed its safe values [modbus-link-2].
  bool make_safe() noexcept override { return master_.is_safe(); }

 protected:
  ModbusMaster& master() noexcept { return master_; }

 private:
  ModbusMaster master_;
};

}  // namespace flexrf
