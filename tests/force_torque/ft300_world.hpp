// The real driver on a serial line, whose far end is the simulator.
#pragma once

#include <poll.h>

#include "hal/interfaces/force_torque_sensor/conformance/sensor_bench.hpp"
#include "hal/linux/ft300_sensor/ft300_sensor.hpp"
#include "hal/simulated/ft300_simulator/ft300_server.hpp"

namespace flexrf {

class Ft300World : public BenchWorld<Ft300Sensor> {
 public:
  Ft300World() : BenchWorld(MonotonicClock::now()) {}

  Status start(const ForceTorqueSetting& setting) override {
    driver().stop();
    if (const Status status = plug(); !status) return status;
    configure_sensor(bench().configuration(), setting,
                     4);  // a loaded machine takes long, and may stand still
    bench().configuration().set_device(device());
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
    force_ = force;
    torque_ = torque;
    if (server_ != nullptr) server_->set_load(force, torque);
  }
  bool make(SensorFarEnd behaviour) override {
    using Behaviour = Ft300Server::Behaviour;
    switch (behaviour) {
      case SensorFarEnd::well:
        if (server_ == nullptr) return plug().is_ok();
        server_->set_behaviour(Behaviour::well);
        return true;
      case SensorFarEnd::off:
        server_->switch_off_and_on();
        server_->set_behaviour(Behaviour::silent);
        return true;
      case SensorFarEnd::silent:
        server_->set_behaviour(Behaviour::silent);
        return true;
      case SensorFarEnd::damaged:
        server_->set_behaviour(Behaviour::damaged);
        return true;
      case SensorFarEnd::truncated:
        server_->set_behaviour(Behaviour::truncated);
        return true;
      case SensorFarEnd::unplugged:
        return unplug();
      default:
        return false;  // its stream tells no such thing
    }
  }

 protected:
  /// Begins the simulator on its end of the line.
  virtual Status plug() = 0;
  virtual bool unplug() { return false; }
  virtual const char* device() const = 0;

  Status serve(Result<std::unique_ptr<Ft300Server>> server) {
    if (!server) return server.status();
    server_ = std::move(*server);
    server_->set_load(force_, torque_);
    return {};
  }
  void end_server() { server_.reset(); }

 private:
  std::unique_ptr<Ft300Server> server_;
  std::array<double, 3> force_{};
  std::array<double, 3> torque_{};
};

}  // namespace flexrf
