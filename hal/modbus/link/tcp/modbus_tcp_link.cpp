#include "hal/modbus/link/tcp/modbus_tcp_link.hpp"

#include <string>

namespace flexrf {

Status ModbusTcpLink::initialise() {
  const std::string address(configuration.address_view());
  const Status status =
      client_.use_tcp(address.c_str(), configuration.port, duration_of(configuration.response_timeout));
  if (!status) return status;
  return master().start(
      name(), client_,
      {duration_of(configuration.reconnect_shortest), duration_of(configuration.reconnect_longest),
       duration_of(configuration.pause_after_connecting)},
      environment().longest_step);
}

Result<ModbusExchange*> ModbusTcpLink::attach(const ModbusStationSetup& setup) {
  if (setup.unit_id > 247 && setup.unit_id < 255) {
    return Status::error(StatusCode::invalid_argument,
                         "unit_id %d is reserved: 255 is a station with its own network socket, 1 to 247 are "
                         "behind a gateway",
                         int{setup.unit_id});
  }
  return ModbusTcpLinkDriver::attach(setup);
}

void ModbusTcpLink::stop() {
  master().stop();
}

}  // namespace flexrf
