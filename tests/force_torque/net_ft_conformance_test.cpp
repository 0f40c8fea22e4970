// The real driver over UDP on the loopback address.
#include <poll.h>

#include "hal/interfaces/force_torque_sensor/conformance/sensor_bench.hpp"
#include "hal/linux/net_ft_sensor/net_ft_sensor.hpp"
#include "hal/simulated/net_ft_simulator/net_ft_server.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

class NetFtWorld final : public BenchWorld<NetFtSensor> {
 public:
  NetFtWorld() : BenchWorld(MonotonicClock::now()) {}
  ~NetFtWorld() override { driver().stop(); }

  Status start(const ForceTorqueSetting& setting) override {
    if (const Status status = server_.plug(); !status) return status;
    auto& configuration = bench().configuration();
    configure_sensor(configuration, setting, 4);  // a loaded machine takes long, and may stand still
    configuration.set_address("127.0.0.1");
    configuration.port = server_.port();
    bench().environment().virtual_time = false;
    return driver().initialise();
  }
  void receive() override {
    pollfd wanted{driver().descriptor(), POLLIN, 0};
    poll(&wanted, 1, 5);
    advance(MonotonicClock::now() - bench().now());
  }
  bool has_virtual_time() const override { return false; }
  void load(const std::array<double, 3>& force, const std::array<double, 3>& torque) override {
    server_.with_model([&](NetFtModel& model) { model.set_load(force, torque); });
  }
  bool make(SensorFarEnd behaviour) override {
    const bool unplugged = behaviour_ == SensorFarEnd::unplugged;
    behaviour_ = behaviour;
    if (unplugged) return server_.plug().is_ok();
    switch (behaviour) {
      case SensorFarEnd::unplugged:
        server_.unplug();
        return true;
      case SensorFarEnd::saturated:
        return set_status(NetFtModel::saturated);
      case SensorFarEnd::faulty:
        return set_status(NetFtModel::supply_fault);
      case SensorFarEnd::off:
        server_.with_model([](NetFtModel& model) { model.switch_off_and_on(); });
        return behave(NetFtModel::Behaviour::silent);
      case SensorFarEnd::silent:
        return behave(NetFtModel::Behaviour::silent);
      case SensorFarEnd::damaged:
        return behave(NetFtModel::Behaviour::damaged);
      case SensorFarEnd::truncated:
        return behave(NetFtModel::Behaviour::truncated);
      case SensorFarEnd::foreign:
        return behave(NetFtModel::Behaviour::foreign);
      case SensorFarEnd::well:
        break;
    }
    return set_status(0) && behave(NetFtModel::Behaviour::well);
  }
  bool lose(std::uint32_t count) override {
    server_.with_model([count](NetFtModel& model) { model.lose(count); });
    return true;
  }

 private:
  bool set_status(std::uint32_t status) {
    server_.with_model([status](NetFtModel& model) { model.set_status(status); });
    return true;
  }
  bool behave(NetFtModel::Behaviour behaviour) {
    server_.with_model([behaviour](NetFtModel& model) { model.set_behaviour(behaviour); });
    return true;
  }

  NetFtServer server_{200};
  SensorFarEnd behaviour_ = SensorFarEnd::well;
};

Status refusal(const char* address, std::uint16_t port) {
  DeviceBench<NetFtSensor> bench(nullptr);
  bench.configuration().set_address(address);
  bench.configuration().port = port;
  return bench.driver().initialise();
}

void what_is_no_address_is_refused(void**) {
  assert_int_equal(refusal("sensor.local", 49152).code(), StatusCode::invalid_argument);
  assert_int_equal(refusal("10.0.0.300", 49152).code(), StatusCode::invalid_argument);
  assert_int_equal(refusal("127.0.0.1", 0).code(), StatusCode::invalid_argument);
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {cmocka_unit_test(what_is_no_address_is_refused)};
  return cmocka_run_group_tests(tests, nullptr, nullptr) +
         run_force_torque_conformance("Net F/T over UDP", []() -> std::unique_ptr<ForceTorqueWorld> {
           return std::make_unique<NetFtWorld>();
         });
}
