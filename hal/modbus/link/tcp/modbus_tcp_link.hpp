// ModbusTcpLink: stations over Modbus TCP.
#pragma once

#include "hal/modbus/link/client/modbus_client.hpp"
#include "modbus_tcp_link_driver.hpp"

namespace flexrf {

/// A peer that is not there is no failure to start: it is looked for until it is.
class ModbusTcpLink final : public ModbusTcpLinkDriver {
 public:
  Status initialise() override;
  void stop() override;
  Result<ModbusExchange*> attach(const ModbusStationSetup& setup) override;

 private:
  ModbusClient client_;
};

}  // namespace flexrf
