#include "hal/modbus/link/simulated/simulated_modbus_link.hpp"
#include "hal/modbus/station/conformance/linked_world.hpp"
#include "hal/modbus/station/simulated/simulated_modbus_station.hpp"

namespace {

using namespace flexrf;

class SimulatedWorld final : public LinkedWorld<SimulatedModbusLink, SimulatedModbusStation> {
 public:
  bool make(ModbusFarEnd behaviour) override {
    switch (behaviour) {
      case ModbusFarEnd::well:
        fault(ModbusWireFault::none);
        return true;
      case ModbusFarEnd::silent:
        fault(ModbusWireFault::silent);
        return true;
      case ModbusFarEnd::refuses:
        fault(ModbusWireFault::refused);
        return true;
      case ModbusFarEnd::damaged:
        fault(ModbusWireFault::damaged);
        return true;
      case ModbusFarEnd::disconnected:
        fault(ModbusWireFault::disconnected);
        link().registers().clear();
        return true;
      case ModbusFarEnd::slow:
      case ModbusFarEnd::truncated:
      case ModbusFarEnd::other_unit:
      case ModbusFarEnd::cut:
        break;
    }
    return false;
  }

 private:
  void prepare(const ModbusRegisterMap& /*map*/, SimulatedModbusLink::Configuration& link) override {
    link.delay = 0.0005;
  }
  Duration pass_time() override { return std::chrono::milliseconds(1); }
  void put_word(ModbusArea area, std::uint16_t address, std::uint16_t value) override {
    *link().registers().find(1, area, address) = value;
  }
  std::uint16_t word(ModbusArea area, std::uint16_t address) override {
    return *link().registers().find(1, area, address);
  }
  void fault(ModbusWireFault which) { link().registers().set_fault(which); }
};

}  // namespace

int main() {
  return run_modbus_station_conformance(
      "simulated Modbus station",
      []() -> std::unique_ptr<ModbusStationWorld> { return std::make_unique<SimulatedWorld>(); });
}
