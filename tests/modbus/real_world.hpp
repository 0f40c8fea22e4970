// The real station and link; their far end is a ModbusServer.
#pragma once

#include <ctime>

#include "hal/interfaces/modbus_station/conformance/linked_world.hpp"
#include "hal/linux/modbus_rtu_link/modbus_rtu_link.hpp"
#include "hal/linux/modbus_tcp_link/modbus_tcp_link.hpp"
#include "hal/linux/real_modbus_station/real_modbus_station.hpp"
#include "hal/simulated/modbus_server/modbus_server.hpp"

namespace flexrf {

template <class Link>
class RealWorld : public LinkedWorld<Link, RealModbusStation> {
 public:
  bool make(ModbusFarEnd behaviour) override {
    using Behaviour = ModbusServer::Behaviour;
    switch (behaviour) {
      case ModbusFarEnd::well:
        return reconnect();
      case ModbusFarEnd::disconnected:
        return disconnect();
      case ModbusFarEnd::silent:
        return behave(Behaviour::silent);
      case ModbusFarEnd::slow:
        return behave(Behaviour::slow);
      case ModbusFarEnd::refuses:
        return behave(Behaviour::refuses);
      case ModbusFarEnd::damaged:
        return behave(Behaviour::damaged);
      case ModbusFarEnd::truncated:
        return behave(Behaviour::truncated);
      case ModbusFarEnd::other_unit:
        return checks_unit() && behave(Behaviour::other_unit);
    }
    return false;
  }
  /// The benches count from a time of their own until the first cycle.
  Time now() const override { return MonotonicClock::now(); }
  int requests() override { return server_->requests(); }
  ModbusServer& server() { return *server_; }

 protected:
  virtual bool disconnect() = 0;
  virtual bool reconnect() { return behave(ModbusServer::Behaviour::well); }
  /// Over TCP libmodbus knows an answer by its transaction, and does not look at its unit.
  virtual bool checks_unit() const { return true; }

  bool behave(ModbusServer::Behaviour behaviour) {
    server_->set_behaviour(behaviour);
    return true;
  }
  void take(Result<std::unique_ptr<ModbusServer>> server) {
    if (server) server_ = std::move(*server);
  }
  void drop_server() { server_.reset(); }

 private:
  Duration pass_time() override {
    const timespec pause{0, 200'000};
    nanosleep(&pause, nullptr);
    return MonotonicClock::now() - LinkedWorld<Link, RealModbusStation>::now();
  }
  void put_word(ModbusArea area, std::uint16_t address, std::uint16_t value) override {
    server_->put(area, address, value);
  }
  std::uint16_t word(ModbusArea area, std::uint16_t address) override { return server_->word(area, address); }

  std::unique_ptr<ModbusServer> server_;
};

class TcpWorld final : public RealWorld<ModbusTcpLink> {
 protected:
  void prepare(const ModbusRegisterMap& /*map*/, ModbusTcpLink::Configuration& link) override {
    take(ModbusServer::on_tcp(1, 0));
    link.port = server().port();
  }
  bool disconnect() override {
    behave(ModbusServer::Behaviour::cut);
    server().clear();
    return true;
  }
  bool checks_unit() const override { return false; }
};

}  // namespace flexrf
