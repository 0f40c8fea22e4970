#include "hal/modbus/link/rtu/modbus_rtu_link.hpp"

#include <string>

namespace flexrf {
namespace {

char letter_of(ModbusParity parity) {
  switch (parity) {
    case ModbusParity::even:
      return 'E';
    case ModbusParity::odd:
      return 'O';
    case ModbusParity::none:
      break;
  }
  return 'N';
}

}  // namespace

Status ModbusRtuLink::initialise() {
  const std::string device(configuration.device_view());
  const Status status = client_.use_rtu(
      {device.c_str(), configuration.baud, letter_of(configuration.parity), configuration.stop_bits},
      duration_of(configuration.response_timeout));
  if (!status) return status;
  return master().start(
      name(), client_,
      {duration_of(configuration.reconnect_shortest), duration_of(configuration.reconnect_longest),
       duration_of(configuration.pause_after_connecting)},
      environment().longest_step);
}

Result<ModbusExchange*> ModbusRtuLink::attach(const ModbusStationSetup& setup) {
  if (setup.unit_id < 1 || setup.unit_id > 247) {
    return Status::error(StatusCode::invalid_argument,
                         "unit_id %d is no station's on a serial line: 1 to 247 are (0 would be all of them)",
                         int{setup.unit_id});
  }
  return ModbusRtuLinkDriver::attach(setup);
}

void ModbusRtuLink::stop() {
  master().stop();
}

}  // namespace flexrf
