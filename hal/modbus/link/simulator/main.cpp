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
//   well | silent | slow | refuses | off_behind_gateway | damaged | truncated | other_unit | cut
//                              how it answers from now on
//   unplug | plug              a pseudo-terminal: its adapter is pulled out; plugged in, with the line's new
//                              name and every register 0
//
// Runs until it is interrupted.
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>

#include "base/standard_descriptors.hpp"
#include "hal/modbus/link/simulator/modbus_server.hpp"
#include "hal/modbus/link/simulator/pseudo_serial_line.hpp"

namespace {

using namespace flexrf;

constexpr const char* usage =
    "usage: modbus_server (--tcp PORT | --serial DEVICE BAUD | --pseudo-terminal) [--unit N]\n";

enum class Line { none, tcp, serial, pseudo_terminal };

struct Command {
  Line line = Line::none;
  const char* device = "";
  long number = 0;  // port or baud
  long unit = 1;
};

bool is_number(const char* text, long least, long most, long& value) {
  char* end = nullptr;
  value = std::strtol(text, &end, 10);
  return end != text && *end == '\0' && value >= least && value <= most;
}

bool parse(int count, char** words, Command& command) {
  for (int i = 1; i < count; ++i) {
    const int left = count - i - 1;
    if (std::strcmp(words[i], "--tcp") == 0 && left >= 1) {
      command.line = Line::tcp;
      if (!is_number(words[++i], 0, 65535, command.number)) return false;
    } else if (std::strcmp(words[i], "--serial") == 0 && left >= 2) {
      command.line = Line::serial;
      command.device = words[++i];
      if (!is_number(words[++i], 1200, 921600, command.number)) return false;
    } else if (std::strcmp(words[i], "--pseudo-terminal") == 0) {
      command.line = Line::pseudo_terminal;
    } else if (std::strcmp(words[i], "--unit") == 0 && left >= 1) {
      if (!is_number(words[++i], 0, 255, command.unit)) return false;
    } else {
      return false;
    }
  }
  return command.line != Line::none;
}

class Console {
 public:
  explicit Console(const Command& command) : command_(command) {}

  Status plug() {
    if (command_.line == Line::pseudo_terminal) {
      if (const Status status = pseudo_.open(); !status) return status;
    }
    auto server = begin(static_cast<std::uint8_t>(command_.unit));
    if (!server) return server.status();
    server_ = std::move(*server);
    return {};
  }

  /// Where it is to be found.
  std::string place() const {
    if (command_.line == Line::tcp) return "127.0.0.1 port " + std::to_string(server_->port());
    return command_.line == Line::serial ? command_.device : pseudo_.path();
  }

  /// The answer, without the end of the line.
  std::string answer(const char* line) {
    char first[24] = "";
    char area[24] = "";
    unsigned address = 0;
    unsigned value = 0;
    const int parts = std::sscanf(line, "%23s %23s %u %u", first, area, &address, &value);
    const std::string_view command = first;
    if (parts == 1 && command_.line == Line::pseudo_terminal && (command == "plug" || command == "unplug"))
      return command == "plug" ? plugged() : unplugged();
    if (server_ == nullptr) return "it is unplugged";
    if (parts >= 3 && address <= greatest && value <= greatest)
      return registers_obey(command, area, parts, address, value);
    if (parts != 1) return refusal;
    if (command == "requests") return std::to_string(server_->requests());
    if (command == "clear") {
      server_->clear();
      return "ok";
    }
    const auto behaviour = ModbusServer::behaviour_named(command);
    if (!behaviour) return refusal;
    server_->set_behaviour(*behaviour);
    return "ok";
  }

 private:
  static constexpr unsigned greatest = 65535;  // address and value
  static constexpr const char* refusal = "that is no command";

  Result<std::unique_ptr<ModbusServer>> begin(std::uint8_t unit) const {
    if (command_.line == Line::tcp)
      return ModbusServer::on_tcp(unit, static_cast<std::uint16_t>(command_.number));
    if (command_.line == Line::serial)
      return ModbusServer::on_serial_line(unit, command_.device, static_cast<int>(command_.number));
    return ModbusServer::on_descriptor(unit, pseudo_.descriptor());
  }
  std::string plugged() {
    const Status status = plug();
    return status ? place() : status.cause();
  }
  std::string unplugged() {
    server_.reset();
    pseudo_.close();
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
    return refusal;
  }

  Command command_;
  PseudoSerialLine pseudo_;
  std::unique_ptr<ModbusServer> server_;  // ends before its line; null: unplugged
};

}  // namespace

int main(int count, char** words) {
  flexrf::hold_standard_descriptors();
  Command command;
  if (!parse(count, words, command)) {
    std::fputs(usage, stderr);
    return 2;
  }
  Console console(command);
  if (const Status status = console.plug(); !status) {
    std::fprintf(stderr, "modbus_server: %s\n", status.cause());
    return 1;
  }
  std::puts(console.place().c_str());
  std::fflush(stdout);
  char line[128];
  while (std::fgets(line, sizeof(line), stdin) != nullptr) {
    std::puts(console.answer(line).c_str());
    std::fflush(stdout);
  }
  while (true) pause();
}
