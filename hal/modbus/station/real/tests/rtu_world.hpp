// A serial link over a pseudo-terminal, which can be unplugged.
#pragma once

#include <unistd.h>

#include <cstdlib>

#include "hal/modbus/station/real/tests/real_world.hpp"

namespace flexrf {

class RtuWorld final : public RealWorld<ModbusRtuLink> {
 public:
  ~RtuWorld() override {
    unlink(name_.c_str());
    rmdir(folder_);
  }

 private:
  void prepare(const ModbusRegisterMap& /*map*/, ModbusRtuLink::Configuration& link) override {
    if (mkdtemp(folder_) == nullptr) return;
    // A name that stays, as /dev/serial/by-id has: the pseudo-terminal behind it is another each time.
    name_ = std::string(folder_) + "/line";
    link.set_device(name_);
    in_ = name(switch_on({"--pseudo-terminal"}));
  }
  bool disconnect() override {
    unlink(name_.c_str());
    in_ = false;
    return say("unplug");
  }
  bool reconnect() override {
    if (in_) return RealWorld::reconnect();
    in_ = name(ask("plug"));
    return in_;
  }
  bool name(const std::string& line) const { return symlink(line.c_str(), name_.c_str()) == 0; }

  char folder_[32] = "/tmp/flexrf-modbus-XXXXXX";
  std::string name_;
  bool in_ = false;
};

}  // namespace flexrf
