#include "hal/driver/device_bench.hpp"
#include "hal/modbus/station/conformance/modbus_station_conformance.hpp"
#include "hal/modbus/station/mock/mock_modbus_station.hpp"

namespace {

using namespace flexrf;

class MockWorld final : public ModbusStationWorld {
 public:
  Status start(const ModbusRegisterMap& map) override {
    bench_.emplace(&map);
    bench_->driver().set_inhibited(true);
    bench_->configuration().normal_period = 0;
    bench_->configuration().slow_period = 3600;
    return bench_->driver().initialise();
  }
  ModbusStation& station() override { return bench_->driver(); }
  void receive() override { bench_->receive(std::chrono::milliseconds(1)); }
  void send() override { bench_->send(); }
  Time now() const override { return bench_->now(); }
  void put(std::size_t index, double value) override { bench_->driver().put(index, value); }
  void put_text(std::size_t index, std::string_view text) override { bench_->driver().put_text(index, text); }
  double held(std::size_t index) override { return bench_->driver().held(index); }
  bool make(ModbusFarEnd behaviour) override {
    switch (behaviour) {
      case ModbusFarEnd::well:
        bench_->driver().set_fault(MockModbusStation::Fault::none);
        return true;
      case ModbusFarEnd::silent:
        bench_->driver().set_fault(MockModbusStation::Fault::silent);
        return true;
      case ModbusFarEnd::refuses:
        bench_->driver().set_fault(MockModbusStation::Fault::refused);
        return true;
      case ModbusFarEnd::disconnected:
        bench_->driver().set_fault(MockModbusStation::Fault::disconnected);
        return true;
      case ModbusFarEnd::slow:
      case ModbusFarEnd::damaged:
      case ModbusFarEnd::truncated:
      case ModbusFarEnd::other_unit:
      case ModbusFarEnd::cut:
        break;
    }
    return false;
  }

 private:
  std::optional<DeviceBench<MockModbusStation>> bench_;
};

}  // namespace

int main() {
  return run_modbus_station_conformance("mock Modbus station", []() -> std::unique_ptr<ModbusStationWorld> {
    return std::make_unique<MockWorld>();
  });
}
