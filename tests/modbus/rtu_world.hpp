// A serial link over a pseudo-terminal, which can be unplugged.
#pragma once

#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "hal/simulated/modbus_server/pseudo_serial_line.hpp"
#include "tests/modbus/real_world.hpp"

namespace flexrf {

class RtuWorld final : public RealWorld<ModbusRtuLink> {
 public:
  ~RtuWorld() override {
    unplug();
    rmdir(folder_);
  }

 protected:
  void prepare(const ModbusRegisterMap& /*map*/, ModbusRtuLink::Configuration& link) override {
    if (mkdtemp(folder_) == nullptr) return;
    // A name that stays, as /dev/serial/by-id has: the pseudo-terminal behind it is another each time.
    std::snprintf(name_, sizeof(name_), "%s/line", folder_);
    link.set_device(name_);
    plug();
  }
  bool disconnect() override {
    unplug();
    return true;
  }
  bool reconnect() override { return line_.descriptor() >= 0 ? RealWorld::reconnect() : plug(); }

 private:
  bool plug() {
    if (!line_.open()) return false;
    take(ModbusServer::on_descriptor(1, line_.descriptor()));
    return symlink(line_.path().c_str(), name_) == 0;
  }
  void unplug() {
    unlink(name_);
    drop_server();
    line_.close();
  }

  char folder_[32] = "/tmp/flexrf-modbus-XXXXXX";
  char name_[64] = "";
  PseudoSerialLine line_;
};

}  // namespace flexrf
