// In the guest, where a bound in time holds. To be disconnected is to end: there is nobody at the port then.
#include "hal/modbus/station/real/tests/real_world.hpp"

namespace {

using namespace flexrf;

class CountedTcpWorld final : public TcpWorld {
 public:
  bool has_counted_time() const override { return true; }

 protected:
  bool disconnect() override {
    switch_off();
    return true;
  }
  bool reconnect() override { return is_plugged() ? TcpWorld::reconnect() : switch_on_again(); }
};

}  // namespace

int main() {
  return run_modbus_station_conformance(
      "real Modbus station over TCP, in counted time",
      []() -> std::unique_ptr<ModbusStationWorld> { return std::make_unique<CountedTcpWorld>(); });
}
