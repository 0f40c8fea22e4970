#include <optional>

#include "hal/driver/device_bench.hpp"
#include "hal/gripper/conformance/gripper_conformance.hpp"
#include "hal/gripper/simulated/simulated_gripper.hpp"
#include "hal/modbus/link/simulated/simulated_modbus_link.hpp"

namespace {

using namespace flexrf;

class SimulatedWorld final : public GripperWorld {
 public:
  Status start(const GripperSetting& setting) override {
    link_.configuration().response_timeout = 0.1;
    if (const Status status = link_.driver().initialise(); !status) return status;
    gripper_.emplace(nullptr, std::span<QueueSink* const>{}, &link_.driver());
    configure_gripper(gripper_->configuration(), setting);
    return gripper_->driver().initialise();
  }
  Gripper& gripper() override { return gripper_->driver(); }
  void receive() override {
    link_.receive(std::chrono::milliseconds(7));
    gripper_->receive(std::chrono::milliseconds(7));
  }
  void send() override {
    gripper_->send();
    link_.send();
  }
  Time now() const override { return link_.now(); }
  double fingers() override { return model().fingers(); }

  bool put_object(double width) override {
    model().put_object(width);
    return true;
  }
  bool put_around(double room) override {
    model().put_around(room);
    return true;
  }
  bool take_away() override {
    model().take_away();
    return true;
  }
  bool make(GripperFarEnd behaviour) override {
    switch (behaviour) {
      case GripperFarEnd::well:
        model().set_stuck(false);
        return wire(ModbusWireFault::none);
      case GripperFarEnd::silent:
        return wire(ModbusWireFault::silent);
      case GripperFarEnd::off:
        model().switch_off_and_on();
        return wire(ModbusWireFault::silent);
      case GripperFarEnd::unplugged:
        return wire(ModbusWireFault::disconnected);
      case GripperFarEnd::damaged:
        return wire(ModbusWireFault::damaged);
      case GripperFarEnd::stuck:
        model().set_stuck(true);
        return true;
      case GripperFarEnd::tripped:
        model().set_fault(0x0E);
        return true;
      case GripperFarEnd::switch_broken:
        break;
    }
    return false;
  }

 private:
  robotiq::RobotiqModel& model() { return gripper_->driver().model(); }
  bool wire(ModbusWireFault fault) {
    link_.driver().registers().set_fault(fault);
    return true;
  }

  DeviceBench<SimulatedModbusLink> link_{nullptr};
  std::optional<DeviceBench<SimulatedGripper>> gripper_;  // goes before its link
};

}  // namespace

int main() {
  return run_gripper_conformance("simulated gripper", []() -> std::unique_ptr<GripperWorld> {
    return std::make_unique<SimulatedWorld>();
  });
}
