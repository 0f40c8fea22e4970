// In the guest, whose /dev/ttyS1 and /dev/ttyS2 are two UARTs on one wire.
#include "tests/modbus/real_world.hpp"

namespace {

using namespace flexrf;

class SerialLineWorld final : public RealWorld<ModbusRtuLink> {
 protected:
  void prepare(const ModbusRegisterMap& /*map*/, ModbusRtuLink::Configuration& link) override {
    link.set_device("/dev/ttyS2");
    link.baud = 115200;
    link.parity = ModbusParity::even;
    link.stop_bits = 1;
    take(ModbusServer::on_serial_line(1, "/dev/ttyS1", 115200));
  }
  /// The wire between the two cannot be cut.
  bool disconnect() override { return false; }
};

}  // namespace

int main() {
  return run_modbus_station_conformance(
      "real Modbus station over RTU, on a serial line",
      []() -> std::unique_ptr<ModbusStationWorld> { return std::make_unique<SerialLineWorld>(); });
}
