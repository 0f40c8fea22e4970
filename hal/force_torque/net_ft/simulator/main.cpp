// net_ft_simulator: an ATI force-torque sensor to try a cell with.
//
//   net_ft_simulator [--port N] [--rate HERTZ]
//
// Says where it is, then takes commands from standard input, a line each, and answers each by a line:
//
//   force X Y Z | torque X Y Z     what loads it, in N and N m
//   status HEXADECIMAL             its status, as C0000000: the load is out of range
//   lose N                         so many of the next records
//   off                            without power and with it again: everything is forgotten
//   silent | damaged | truncated | foreign | well     what it sends from now on
//   unplug | plug                  nobody is at its port; somebody is again, and everything forgotten
//
// Runs until it is interrupted.
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <utility>

#include "base/standard_descriptors.hpp"
#include "hal/force_torque/net_ft/simulator/net_ft_server.hpp"

namespace {

using namespace flexrf;

constexpr const char* usage = "usage: net_ft_simulator [--port N] [--rate HERTZ]\n";

struct Options {
  double port = rdt::usual_port;
  double rate = 1000;
};

bool is_number(const char* text, double least, double most, double& value) {
  char* end = nullptr;
  value = std::strtod(text, &end);
  return end != text && *end == '\0' && value >= least && value <= most;
}

bool parse(int count, char** words, Options& options) {
  for (int i = 1; i + 1 < count; i += 2) {
    if (std::strcmp(words[i], "--port") == 0) {
      if (!is_number(words[i + 1], 0, 65535, options.port)) return false;
    } else if (std::strcmp(words[i], "--rate") == 0) {
      if (!is_number(words[i + 1], 1, 8000, options.rate)) return false;
    } else {
      return false;
    }
  }
  return count % 2 == 1;
}

class Simulator {
 public:
  explicit Simulator(double rate) : server_(rate) {}
  NetFtServer& server() { return server_; }

  const char* answer(const char* line) {
    char word[16] = "";
    if (std::sscanf(line, "%15s", word) != 1) return "that is no command";
    const std::string_view command = word;
    const char* const rest = std::strstr(line, word) + command.size();
    if (command == "unplug") {
      server_.unplug();
    } else if (command == "plug") {
      if (!server_.plug()) return "its port is taken";
    } else if (command == "force" || command == "torque") {
      auto& values = command == "force" ? force_ : torque_;
      if (std::sscanf(rest, "%lf %lf %lf", &values[0], &values[1], &values[2]) != 3)
        return "three numbers are needed";
      server_.with_model([this](NetFtModel& model) { model.set_load(force_, torque_); });
    } else if (command == "off") {
      server_.with_model([](NetFtModel& model) { model.switch_off_and_on(); });
    } else if (command == "status") {
      const auto status = static_cast<std::uint32_t>(std::strtoul(rest, nullptr, 16));
      server_.with_model([status](NetFtModel& model) { model.set_status(status); });
    } else if (command == "lose") {
      const auto number = static_cast<std::uint32_t>(std::strtoul(rest, nullptr, 10));
      server_.with_model([number](NetFtModel& model) { model.lose(number); });
    } else {
      return behave(command) ? "ok" : "that is no command";
    }
    return "ok";
  }

 private:
  bool behave(std::string_view command) {
    using enum NetFtModel::Behaviour;
    constexpr std::pair<std::string_view, NetFtModel::Behaviour> known[] = {{"well", well},
                                                                            {"silent", silent},
                                                                            {"damaged", damaged},
                                                                            {"truncated", truncated},
                                                                            {"foreign", foreign}};
    for (const auto& [name, behaviour] : known) {
      if (name != command) continue;
      server_.with_model([wanted = behaviour](NetFtModel& model) { model.set_behaviour(wanted); });
      return true;
    }
    return false;
  }

  NetFtServer server_;
  std::array<double, 3> force_{};
  std::array<double, 3> torque_{};
};

}  // namespace

int main(int count, char** words) {
  flexrf::hold_standard_descriptors();
  Options options;
  if (!parse(count, words, options)) {
    std::fputs(usage, stderr);
    return 2;
  }
  Simulator simulator(options.rate);
  if (const Status status = simulator.server().plug(static_cast<std::uint16_t>(options.port)); !status) {
    std::fprintf(stderr, "net_ft_simulator: %s\n", status.cause());
    return 1;
  }
  std::printf("127.0.0.1 port %u\n", unsigned{simulator.server().port()});
  std::fflush(stdout);
  char line[128];
  while (std::fgets(line, sizeof(line), stdin) != nullptr) {
    std::puts(simulator.answer(line));
    std::fflush(stdout);
  }
  while (true) pause();
}
