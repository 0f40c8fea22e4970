// The real driver on a serial line.
#pragma once

#include "hal/force_torque/ft300/ft300_sensor.hpp"
#include "hal/force_torque/tests/sensor_world.hpp"
#include "places.hpp"

namespace flexrf {

class Ft300World : public SensorWorld<Ft300Sensor> {
 public:
  Status start(const ForceTorqueSetting& setting) override {
    driver().stop();
    if (const Status status = plug(); !status) return status;
    configure_sensor(bench().configuration(), setting,
                     4);  // a loaded machine takes long, and may stand still
    bench().configuration().set_device(device());
    bench().environment().virtual_time = false;
    return driver().initialise();
  }
  bool make(SensorFarEnd behaviour) override {
    const bool was_unplugged = behaviour_ == SensorFarEnd::unplugged;
    behaviour_ = behaviour;
    switch (behaviour) {
      case SensorFarEnd::well:
        return was_unplugged ? plug_in() : say("well");
      case SensorFarEnd::off:
        // Silent first: nobody asks it in between.
        return say("silent") && say("off");
      case SensorFarEnd::silent:
        return say("silent");
      case SensorFarEnd::damaged:
        return say("damaged");
      case SensorFarEnd::truncated:
        return say("truncated");
      case SensorFarEnd::unplugged:
        return unplug();
      default:
        return false;  // its stream tells no such thing
    }
  }

 protected:
  /// Begins the simulator on its end of the line.
  virtual Status plug() = 0;
  virtual const char* device() const = 0;
  virtual bool unplug() = 0;
  virtual bool plug_in() = 0;

  Status begin(const std::vector<std::string>& words) {
    return SensorWorld::begin(place::ft300_simulator, words);
  }

 private:
  SensorFarEnd behaviour_ = SensorFarEnd::well;
};

}  // namespace flexrf
