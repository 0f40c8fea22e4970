// In the guest, whose /dev/ttyS1 and /dev/ttyS2 are two UARTs on one wire, and where a bound in time holds.
#include "hal/modbus/station/real/tests/real_world.hpp"

namespace {

using namespace flexrf;

class SerialLineWorld final : public RealWorld<ModbusRtuLink> {
 public:
  bool has_counted_time() const override { return true; }

 private:
  void prepare(const ModbusRegisterMap& /*map*/, ModbusRtuLink::Configuration& link) override {
    link.set_device("/dev/ttyS2");
    link.baud = 115200;
    link.parity = ModbusParity::even;
    link.stop_bits = 1;
    plug();
  }
  /// The wire between the two cannot be cut: nobody is at its other end, as with a cable that is out.
  bool disconnect() override {
    switch_off();
    return true;
  }
  bool reconnect() override { return is_plugged() ? RealWorld::reconnect() : plug(); }
  bool plug() { return !switch_on({"--serial", "/dev/ttyS1", "115200"}).empty(); }
};

}  // namespace

int main() {
  return run_modbus_station_conformance(
      "real Modbus station over RTU, on a serial line",
      []() -> std::unique_ptr<ModbusStationWorld> { return std::make_unique<SerialLineWorld>(); });
}
