// modbus_server: a Modbus station to try a cell with.
//
//   modbus_server (--tcp PORT | --serial DEVICE BAUD | --pseudo-terminal) [--unit N]
//
// Has every register, 0 at first. Says where it is to be found, then takes commands from standard input, a
// line each, and answers each by a line:
//
//   put AREA ADDRESS VALUE     a word of a coil, discrete_input, holding_register or input_register
//   word AREA ADDRESS          what it is
//   clear                      every register becomes 0
//   requests                   to this unit so far
//   well | silent | slow | refuses | off_behind_gateway | damaged | truncated | other_unit | only_single |
//   only_multiple | cut
//                              how it answers from now on
//   unplug | plug              a pseudo-terminal: its adapter is pulled out; plugged in, with the line's new
//                              name and every register 0
//
// Runs until it is interrupted.
#include <cstdio>
#include <string_view>

#include "hal/modbus/link/simulator/modbus_server.hpp"
#include "hal/modbus/link/simulator/serial_simulator.hpp"

namespace flexrf {
namespace {

class StationSimulator final : public SerialSimulator {
 public:
  bool read(CommandLine& line) override {
    line.number("--unit", 0, 255, unit_);
    line.number("--tcp", 0, 65535, port_);
    const bool is_serial = use_line(line, line.word_and_number("--serial", 1200, 921600, baud_));
    return is_tcp() ? device() == nullptr && !is_pseudo_terminal() : is_serial;
  }
  std::string place() const override {
    return is_tcp() ? "127.0.0.1 port " + std::to_string(server_->port()) : SerialSimulator::place();
  }

 private:
  static constexpr unsigned greatest = 65535;  // address and value

  bool is_tcp() const noexcept { return port_ >= 0; }
  Status plug() override {
    auto server = serve(static_cast<std::uint8_t>(unit_));
    if (!server) return server.status();
    server_ = std::move(*server);
    return {};
  }
  void unplug() override { server_.reset(); }
  Result<std::unique_ptr<ModbusServer>> serve(std::uint8_t unit) const {
    if (is_tcp()) return ModbusServer::on_tcp(unit, static_cast<std::uint16_t>(port_));
    if (is_pseudo_terminal()) return ModbusServer::on_descriptor(unit, descriptor());
    return ModbusServer::on_serial_line(unit, device(), static_cast<int>(baud_));
  }

  std::string obey(const std::string& line) override {
    char first[24] = "";
    char area[24] = "";
    unsigned address = 0;
    unsigned value = 0;
    const int parts = std::sscanf(line.c_str(), "%23s %23s %u %u", first, area, &address, &value);
    const std::string_view command = first;
    if (server_ == nullptr) return "it is unplugged";
    if (parts >= 3 && address <= greatest && value <= greatest)
      return registers_obey(command, area, parts, address, value);
    if (parts != 1) return no_command;
    if (command == "requests") return std::to_string(server_->requests());
    if (command == "clear") {
      server_->clear();
      return "ok";
    }
    const auto behaviour = ModbusServer::behaviour_named(command);
    if (!behaviour) return no_command;
    server_->set_behaviour(*behaviour);
    return "ok";
  }

  std::string registers_obey(std::string_view command, std::string_view name, int parts, unsigned address,
                             unsigned value) {
    using enum ModbusArea;
    for (const ModbusArea area : {holding_register, input_register, coil, discrete_input}) {
      if (name != name_of(area)) continue;
      const auto at = static_cast<std::uint16_t>(address);
      if (command == "word" && parts == 3) return std::to_string(server_->word(area, at));
      if (command != "put" || parts != 4) break;
      server_->put(area, at, static_cast<std::uint16_t>(value));
      return "ok";
    }
    return no_command;
  }

  double port_ = -1;  // below 0: on a serial line
  double baud_ = 0;
  double unit_ = 1;
  std::unique_ptr<ModbusServer> server_;  // ends before its line; null: unplugged
};

}  // namespace
}  // namespace flexrf

int main(int count, char** words) {
  flexrf::StationSimulator simulator;
  return run_simulator(
      simulator, "modbus_server",
      "usage: modbus_server (--tcp PORT | --serial DEVICE BAUD | --pseudo-terminal) [--unit N]\n", count,
      words);
}
