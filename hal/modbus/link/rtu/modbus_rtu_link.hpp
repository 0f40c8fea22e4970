// ModbusRtuLink: stations on a serial line.
#pragma once

#include "hal/modbus/link/client/modbus_client.hpp"
#include "modbus_rtu_link_driver.hpp"

namespace flexrf {

/// A line that is not there is no failure to start: an adapter may be plugged in later, and is looked for.
class ModbusRtuLink final : public ModbusRtuLinkDriver {
 public:
  Status initialise() override;
  void stop() override;
  Result<ModbusExchange*> attach(const ModbusStationSetup& setup) override;

 private:
  ModbusClient client_;
};

}  // namespace flexrf
