// The real driver on a real serial line, whose far end is the simulator as another process.
#pragma once

#include <cstdlib>
#include <ctime>
#include <optional>

#include "hal/driver/device_bench.hpp"
#include "hal/gripper/conformance/gripper_conformance.hpp"
#include "hal/gripper/robotiq/robotiq_gripper.hpp"
#include "hal/modbus/link/rtu/modbus_rtu_link.hpp"
#include "places.hpp"
#include "tests/simulator_process.hpp"

namespace flexrf {

class RobotiqWorld : public GripperWorld {
 public:
  Status start(const GripperSetting& setting) override {
    const Status prepared = plug();
    if (!prepared) return prepared;
    auto& line = link_.configuration();
    line.baud = 115200;
    line.parity = ModbusParity::none;
    line.response_timeout = 4;  // a loaded machine takes long, and may stand still
    line.reconnect_longest = 0.2;
    line.set_device(device());
    if (const Status status = link_.driver().initialise(); !status) return status;
    gripper_.emplace(nullptr, std::span<QueueSink* const>{}, &link_.driver());
    configure_gripper(gripper_->configuration(), setting);
    gripper_->configuration().max_age = 10;
    gripper_->configuration().travel_timeout = 15;
    gripper_->configuration().activation_timeout = 30;
    return gripper_->driver().initialise();
  }
  Gripper& gripper() override { return gripper_->driver(); }
  void receive() override {
    const timespec pause{0, 200'000};
    nanosleep(&pause, nullptr);
    const Duration elapsed = MonotonicClock::now() - link_.now();
    link_.receive(elapsed);
    gripper_->receive(MonotonicClock::now() - gripper_->now());
  }
  void send() override {
    gripper_->send();
    link_.send();
  }
  Time now() const override { return MonotonicClock::now(); }
  bool has_virtual_time() const override { return false; }
  std::uint64_t exchanges() override {
    return static_cast<const ModbusLinkFeedback*>(link_.driver().parameter_memory().feedback)->requests;
  }
  double fingers() override { return std::atof(simulator_->ask("fingers").c_str()); }

  bool put_object(double width) override { return say("object " + std::to_string(width)); }
  bool put_around(double room) override { return say("around " + std::to_string(room)); }
  bool take_away() override { return say("take"); }
  bool make(GripperFarEnd behaviour) override {
    const GripperFarEnd before = behaviour_;
    behaviour_ = behaviour;
    switch (behaviour) {
      case GripperFarEnd::well:
        if (before == GripperFarEnd::unplugged) return plug_in();
        return say("free") && say(before == GripperFarEnd::off ? "on" : "well");
      case GripperFarEnd::silent:
        return say("silent");
      case GripperFarEnd::off:
        return say("off");
      case GripperFarEnd::unplugged:
        return unplug();
      case GripperFarEnd::damaged:
        return say("damaged");
      case GripperFarEnd::stuck:
        return say("stuck");
      case GripperFarEnd::tripped:
        return say("fault 14");
      case GripperFarEnd::switch_broken:
        break;
    }
    return false;
  }

 protected:
  /// Begins the simulator on its end of the line.
  virtual Status plug() = 0;
  virtual const char* device() const = 0;
  virtual bool unplug() { return false; }
  virtual bool plug_in() { return false; }

  Status begin(std::vector<std::string> words) {
    // What stands still with the machine is on its way as long as it is not halted.
    words.insert(words.end(),
                 {"--width", std::to_string(GripperSetting::open_width), "--longest-step", "0.05"});
    simulator_.emplace(place::robotiq_simulator, words);
    if (simulator_->is_running()) return {};
    return Status::error(StatusCode::unavailable, "the simulator did not begin");
  }
  SimulatorProcess& simulator() { return *simulator_; }
  bool say(const std::string& command) { return simulator_->ask(command) == "ok"; }

 private:
  std::optional<SimulatorProcess> simulator_;
  DeviceBench<ModbusRtuLink> link_{nullptr};
  std::optional<DeviceBench<RobotiqGripper>> gripper_;  // goes before its link
  GripperFarEnd behaviour_ = GripperFarEnd::well;
};

}  // namespace flexrf
