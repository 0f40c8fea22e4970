// The real driver over UDP on the loopback address.
#pragma once

#include <cstdio>

#include "hal/force_torque/net_ft/net_ft_sensor.hpp"
#include "hal/force_torque/tests/sensor_world.hpp"
#include "places.hpp"

namespace flexrf {

class NetFtWorld : public SensorWorld<NetFtSensor> {
 public:
  Status start(const ForceTorqueSetting& setting) override {
    driver().stop();
    if (const Status status = begin(place::net_ft_simulator, {"--port", "0", "--rate", "200"}); !status)
      return status;
    auto& configuration = bench().configuration();
    if (std::sscanf(simulator().first_line().c_str(), "127.0.0.1 port %hu", &configuration.port) != 1)
      return Status::error(StatusCode::unavailable, "the simulator has no port");
    configure_sensor(configuration, setting, 4);  // a loaded machine takes long, and may stand still
    configuration.set_address("127.0.0.1");
    bench().environment().virtual_time = false;
    return driver().initialise();
  }
  bool make(SensorFarEnd behaviour) override {
    const bool was_unplugged = behaviour_ == SensorFarEnd::unplugged;
    behaviour_ = behaviour;
    switch (behaviour) {
      case SensorFarEnd::unplugged:
        return unplug();
      case SensorFarEnd::saturated:
        return say("status C0000000");
      case SensorFarEnd::faulty:
        return say("status 80000002");
      case SensorFarEnd::off:
        // Silent first: nobody asks it in between.
        return say("silent") && say("off");
      case SensorFarEnd::silent:
        return say("silent");
      case SensorFarEnd::damaged:
        return say("damaged");
      case SensorFarEnd::truncated:
        return say("truncated");
      case SensorFarEnd::foreign:
        return say("foreign");
      case SensorFarEnd::well:
        break;
    }
    return was_unplugged ? plug_in() : say("status 0") && say("well");
  }
  bool lose(std::uint32_t count) override { return say("lose " + std::to_string(count)); }

 protected:
  virtual bool unplug() = 0;
  virtual bool plug_in() = 0;

 private:
  SensorFarEnd behaviour_ = SensorFarEnd::well;
};

}  // namespace flexrf
