#include "hal/force_torque/conformance/sensor_bench.hpp"
#include "hal/force_torque/simulated/simulated_force_torque_sensor.hpp"

namespace {

using namespace flexrf;

class SimulatedWorld final : public BenchWorld<SimulatedForceTorqueSensor> {
 public:
  Status start(const ForceTorqueSetting& setting) override {
    configure_sensor(bench().configuration(), setting, 0.1);
    return driver().initialise();
  }
  void receive() override { advance(std::chrono::milliseconds(5)); }
  void load(const std::array<double, 3>& force, const std::array<double, 3>& torque) override {
    bench().configuration().load_force = force;
    bench().configuration().load_torque = torque;
    driver().model().set_load(force, torque);
  }
  bool make(SensorFarEnd behaviour) override {
    using Behaviour = NetFtModel::Behaviour;
    NetFtModel& model = driver().model();
    if (behaviour == SensorFarEnd::off) model.switch_off_and_on();
    model.set_status(behaviour == SensorFarEnd::saturated ? NetFtModel::saturated
                     : behaviour == SensorFarEnd::faulty  ? NetFtModel::supply_fault
                                                          : 0);
    switch (behaviour) {
      case SensorFarEnd::silent:
      case SensorFarEnd::off:
        model.set_behaviour(Behaviour::silent);
        break;
      case SensorFarEnd::damaged:
        model.set_behaviour(Behaviour::damaged);
        break;
      case SensorFarEnd::truncated:
        model.set_behaviour(Behaviour::truncated);
        break;
      case SensorFarEnd::foreign:
        model.set_behaviour(Behaviour::foreign);
        break;
      default:
        model.set_behaviour(Behaviour::well);
    }
    return behaviour != SensorFarEnd::unplugged;
  }
  bool lose(std::uint32_t count) override {
    driver().model().lose(count);
    return true;
  }
};

}  // namespace

int main() {
  return run_force_torque_conformance(
      "simulated force-torque sensor",
      []() -> std::unique_ptr<ForceTorqueWorld> { return std::make_unique<SimulatedWorld>(); });
}
