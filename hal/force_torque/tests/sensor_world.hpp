// The real driver of a force-torque sensor, at whose far end is the simulator as another process.
#pragma once

#include <poll.h>

#include <optional>
#include <string>

#include "hal/force_torque/conformance/sensor_bench.hpp"
#include "tests/simulator_process.hpp"

namespace flexrf {

template <class Driver>
class SensorWorld : public BenchWorld<Driver> {
 public:
  SensorWorld() : BenchWorld<Driver>(MonotonicClock::now()) {}
  ~SensorWorld() override { this->driver().stop(); }

  void receive() override {
    pollfd wanted{this->driver().descriptor(), POLLIN, 0};
    poll(&wanted, 1, 5);
    this->advance(MonotonicClock::now() - this->bench().now());
  }
  bool has_virtual_time() const override { return false; }
  void load(const std::array<double, 3>& force, const std::array<double, 3>& torque) override {
    say("force" + text(force));
    say("torque" + text(torque));
  }

 protected:
  Status begin(const char* executable, const std::vector<std::string>& words) {
    simulator_.reset();
    simulator_.emplace(executable, words);
    if (simulator_->is_running()) return {};
    return Status::error(StatusCode::unavailable, "the simulator did not begin");
  }
  SimulatorProcess& simulator() { return *simulator_; }
  bool say(const std::string& command) { return simulator_->ask(command) == "ok"; }

 private:
  static std::string text(const std::array<double, 3>& values) {
    std::string words;
    for (const double value : values) words += " " + std::to_string(value);
    return words;
  }

  std::optional<SimulatorProcess> simulator_;
};

}  // namespace flexrf
