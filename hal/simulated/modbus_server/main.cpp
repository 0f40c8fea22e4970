// modbus_server: a Modbus station to try a cell with.
//
//   modbus_server (--tcp PORT | --serial DEVICE BAUD | --pseudo-terminal) [--unit N]
//
// Has every register, 0 at first, and tells what was written. Runs until it is interrupted.
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "hal/simulated/modbus_server/modbus_server.hpp"
#include "hal/simulated/modbus_server/pseudo_serial_line.hpp"

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

}  // namespace

int main(int count, char** words) {
  Command command;
  if (!parse(count, words, command)) {
    std::fputs(usage, stderr);
    return 2;
  }
  // Before the server's thread begins, so that only this one is interrupted.
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);

  const auto unit = static_cast<std::uint8_t>(command.unit);
  PseudoSerialLine pseudo;
  Status status;
  if (command.line == Line::pseudo_terminal) status = pseudo.open();
  if (!status) {
    std::fprintf(stderr, "modbus_server: %s\n", status.cause());
    return 1;
  }
  const auto server =
      command.line == Line::tcp ? ModbusServer::on_tcp(unit, static_cast<std::uint16_t>(command.number))
      : command.line == Line::serial
          ? ModbusServer::on_serial_line(unit, command.device, static_cast<int>(command.number))
          : ModbusServer::on_descriptor(unit, pseudo.descriptor());
  if (!server) {
    std::fprintf(stderr, "modbus_server: %s\n", server.status().cause());
    return 1;
  }
  if (command.line == Line::tcp)
    std::printf("127.0.0.1 port %u\n", unsigned{(*server)->port()});
  else
    std::printf("%s\n", command.line == Line::serial ? command.device : pseudo.path().c_str());
  std::fflush(stdout);
  int signal = 0;
  sigwait(&signals, &signal);
  return 0;
}
