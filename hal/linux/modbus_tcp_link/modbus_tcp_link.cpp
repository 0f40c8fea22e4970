#include "hal/linux/modbus_tcp_link/modbus_tcp_link.hpp"

#include <string>

namespace flexrf {
namespace {

Duration duration_of(double seconds) {
  return std::chrono::duration_cast<Duration>(std::chrono::duration<double>(seconds));
}

}  // namespace

Status ModbusTcpLink::initialise() {
  const std::string address(configuration.address_view());
  const Status status =
      client_.use_tcp(address.c_str(), configuration.port, duration_of(configuration.response_timeout));
  if (!status) return status;
  master().start(name(), client_, duration_of(configuration.reconnect_shortest),
                 duration_of(configuration.reconnect_longest));
  return {};
}

void ModbusTcpLink::stop() {
  master().stop();
}

}  // namespace flexrf
