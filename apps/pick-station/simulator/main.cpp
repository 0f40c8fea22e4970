// feeder_simulator: the IO station of the pick station with a feeder behind it, on Modbus TCP.
//
//   feeder_simulator PORT [STOCK]
//
// On the loopback address, as unit 1; STOCK parts, or without end. Runs until it is interrupted.
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "apps/pick-station/world/feeder.hpp"
#include "base/standard_descriptors.hpp"
#include "hal/modbus/link/simulator/modbus_server.hpp"

namespace {

/// −1: it is no number up to `most`.
long number(const char* text, long most) {
  char* end = nullptr;
  const long value = std::strtol(text, &end, 10);
  return end != text && *end == '\0' && value <= most ? value : -1;
}

}  // namespace

int main(int count, char** words) {
  using namespace flexrf;
  hold_standard_descriptors();
  const long port = count >= 2 ? number(words[1], 65535) : -1;
  const long stock = count == 3 ? number(words[2], 1'000'000) : 0;
  if (count > 3 || port < 0 || stock < 0) {
    std::fputs("usage: feeder_simulator PORT [STOCK]\n", stderr);
    return 2;
  }
  user::Feeder feeder({.stock = static_cast<std::uint32_t>(stock)});
  const auto server = ModbusServer::on_tcp(1, static_cast<std::uint16_t>(port));
  if (!server) {
    std::fprintf(stderr, "feeder_simulator: %s\n", server.status().cause());
    return 1;
  }
  (*server)->set_model(&feeder);
  std::printf("127.0.0.1 port %u\n", unsigned{(*server)->port()});
  std::fflush(stdout);
  while (true) pause();
}
