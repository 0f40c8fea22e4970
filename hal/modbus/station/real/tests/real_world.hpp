// The real station and link; their far end is modbus_server, another process.
#pragma once

#include <cstdlib>
#include <ctime>
#include <optional>
#include <string>
#include <vector>

#include "hal/modbus/link/rtu/modbus_rtu_link.hpp"
#include "hal/modbus/link/tcp/modbus_tcp_link.hpp"
#include "hal/modbus/station/conformance/linked_world.hpp"
#include "hal/modbus/station/real/real_modbus_station.hpp"
#include "places.hpp"
#include "tests/simulator_process.hpp"

namespace flexrf {

template <class Link>
class RealWorld : public LinkedWorld<Link, RealModbusStation> {
 public:
  Status start(const ModbusRegisterMap& map) override {
    const Status status = LinkedWorld<Link, RealModbusStation>::start(map);
    if (!status || is_plugged()) return status;
    return Status::error(StatusCode::unavailable, "modbus_server did not begin");
  }
  bool make(ModbusFarEnd behaviour) override {
    switch (behaviour) {
      case ModbusFarEnd::well:
        return reconnect();
      case ModbusFarEnd::disconnected:
        return disconnect();
      case ModbusFarEnd::cut:
        return has_connections() && say("cut");
      case ModbusFarEnd::silent:
        return say("silent");
      case ModbusFarEnd::slow:
        return say("slow");
      case ModbusFarEnd::refuses:
        return say("refuses");
      case ModbusFarEnd::damaged:
        return say("damaged");
      case ModbusFarEnd::truncated:
        return say("truncated");
      case ModbusFarEnd::other_unit:
        return say("other_unit");
    }
    return false;
  }
  /// The benches count from a time of their own until the first cycle.
  Time now() const override { return MonotonicClock::now(); }
  bool has_counted_time() const override { return false; }
  bool has_virtual_time() const override { return false; }
  int requests() override { return std::atoi(ask("requests").c_str()); }
  /// A command of modbus_server that is answered by "ok".
  bool say(const std::string& command) { return ask(command) == "ok"; }

 protected:
  virtual bool disconnect() = 0;
  virtual bool reconnect() { return say("well"); }
  /// A serial line has none, and none is cut.
  virtual bool has_connections() const { return false; }

  /// What it says of where it is to be found; empty: it did not begin.
  const std::string& switch_on(const std::vector<std::string>& arguments) {
    return far_end_.emplace(place::modbus_server, arguments).first_line();
  }
  void switch_off() { far_end_.reset(); }
  bool is_plugged() const { return far_end_ && far_end_->is_running(); }
  std::string ask(const std::string& line) { return far_end_ ? far_end_->ask(line) : std::string(); }

 private:
  Duration pass_time() override {
    // Where instructions are counted, each takes long by the clock of the person who waits for this.
    const timespec pause{0, has_counted_time() ? 2'000'000 : 200'000};
    nanosleep(&pause, nullptr);
    return MonotonicClock::now() - LinkedWorld<Link, RealModbusStation>::now();
  }
  static std::string place(ModbusArea area, std::uint16_t address) {
    return std::string(" ") + name_of(area) + " " + std::to_string(address);
  }
  void put_word(ModbusArea area, std::uint16_t address, std::uint16_t value) override {
    say("put" + place(area, address) + " " + std::to_string(value));
  }
  std::uint16_t word(ModbusArea area, std::uint16_t address) override {
    return static_cast<std::uint16_t>(std::atoi(ask("word" + place(area, address)).c_str()));
  }

  std::optional<SimulatorProcess> far_end_;
};

class TcpWorld : public RealWorld<ModbusTcpLink> {
 protected:
  bool disconnect() override { return say("cut") && say("clear"); }
  /// At the port that it had.
  bool switch_on_again() { return listen_on(port_) != 0; }

 private:
  void prepare(const ModbusRegisterMap& /*map*/, ModbusTcpLink::Configuration& link) override {
    port_ = listen_on(0);
    link.port = port_;
  }
  bool has_connections() const override { return true; }
  /// 0: it did not begin.
  std::uint16_t listen_on(std::uint16_t port) {
    const std::string place = switch_on({"--tcp", std::to_string(port)});
    const std::size_t blank = place.rfind(' ');
    return blank == std::string::npos ? std::uint16_t{0}
                                      : static_cast<std::uint16_t>(std::atoi(place.c_str() + blank));
  }

  std::uint16_t port_ = 0;
};

}  // namespace flexrf
