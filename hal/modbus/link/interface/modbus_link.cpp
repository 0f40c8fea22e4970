#include "hal/modbus/link/interface/modbus_link.hpp"

namespace flexrf {

void ModbusLink::receive(const Tick& /*tick*/) noexcept {
  master_.serve();
  feedback.connected = master_.is_connected();
  feedback.connections = master_.connections();
  feedback.requests = master_.requests();
  feedback.set_last_error(master_.last_error());
}

}  // namespace flexrf
