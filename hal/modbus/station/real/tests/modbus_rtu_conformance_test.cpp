#include "hal/modbus/station/real/tests/rtu_world.hpp"

int main() {
  using namespace flexrf;
  return run_modbus_station_conformance(
      "real Modbus station over RTU, on a pseudo-terminal",
      []() -> std::unique_ptr<ModbusStationWorld> { return std::make_unique<RtuWorld>(); });
}
