#include "hal/modbus/station/real/tests/real_world.hpp"

int main() {
  using namespace flexrf;
  return run_modbus_station_conformance(
      "real Modbus station over TCP",
      []() -> std::unique_ptr<ModbusStationWorld> { return std::make_unique<TcpWorld>(); });
}
