// ft300_simulator: a Robotiq FT300 to try a cell with.
//
//   ft300_simulator (--serial DEVICE | --pseudo-terminal) [--unit N]
//
// Says the name of its line, then takes commands from standard input, a line each, and answers each by a
// line:
//
//   force X Y Z | torque X Y Z     what loads it, in N and N m
//   off                            without power and with it again: everything is forgotten
//   silent | damaged | truncated | well     what it sends from now on
//   unplug | plug                  a pseudo-terminal: its adapter is pulled out; plugged in, with the line's
//                                  new name
//
// Runs until it is interrupted.
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

#include "base/standard_descriptors.hpp"
#include "hal/force_torque/ft300/simulator/ft300_server.hpp"
#include "hal/modbus/link/simulator/pseudo_serial_line.hpp"

namespace {

using namespace flexrf;

constexpr const char* usage = "usage: ft300_simulator (--serial DEVICE | --pseudo-terminal) [--unit N]\n";

struct Options {
  const char* device = nullptr;  // null: a pseudo-terminal
  bool pseudo_terminal = false;
  long unit = ft300::usual_unit_id;
};

bool parse(int count, char** words, Options& options) {
  for (int i = 1; i < count; ++i) {
    const bool has_more = i + 1 < count;
    if (std::strcmp(words[i], "--serial") == 0 && has_more) {
      options.device = words[++i];
    } else if (std::strcmp(words[i], "--pseudo-terminal") == 0) {
      options.pseudo_terminal = true;
    } else if (std::strcmp(words[i], "--unit") == 0 && has_more) {
      char* end = nullptr;
      options.unit = std::strtol(words[++i], &end, 10);
      if (*end != '\0' || options.unit < 1 || options.unit > 247) return false;
    } else {
      return false;
    }
  }
  return options.pseudo_terminal != (options.device != nullptr);
}

class Simulator {
 public:
  explicit Simulator(const Options& options) : options_(options) {}

  Status plug() {
    if (options_.pseudo_terminal) {
      if (const Status status = pseudo_.open(); !status) return status;
    }
    const auto unit = static_cast<std::uint8_t>(options_.unit);
    auto server = options_.pseudo_terminal ? Ft300Server::on_descriptor(pseudo_.descriptor(), unit)
                                           : Ft300Server::on_serial_line(options_.device, unit);
    if (!server) return server.status();
    server_ = std::move(*server);
    server_->set_load(force_, torque_);
    return {};
  }
  const char* line_name() const {
    return options_.pseudo_terminal ? pseudo_.path().c_str() : options_.device;
  }

  /// The answer, without the end of the line.
  std::string answer(const char* line) {
    char word[16] = "";
    if (std::sscanf(line, "%15s", word) != 1) return "that is no command";
    const std::string_view command = word;
    if (command == "unplug" && options_.pseudo_terminal) {
      server_.reset();
      pseudo_.close();
      return "ok";
    }
    if (command == "plug" && options_.pseudo_terminal) {
      const Status status = plug();
      return status ? line_name() : status.cause();
    }
    if (command == "force" || command == "torque") {
      auto& values = command == "force" ? force_ : torque_;
      const char* const rest = std::strstr(line, word) + command.size();
      if (std::sscanf(rest, "%lf %lf %lf", &values[0], &values[1], &values[2]) != 3)
        return "three numbers are needed";
      if (server_ != nullptr) server_->set_load(force_, torque_);
      return "ok";
    }
    if (server_ == nullptr) return "it is unplugged";
    return obeys(command) ? "ok" : "that is no command";
  }

 private:
  bool obeys(std::string_view command) {
    using enum Ft300Server::Behaviour;
    if (command == "off") {
      server_->switch_off_and_on();
    } else if (command == "well") {
      server_->set_behaviour(well);
    } else if (command == "silent") {
      server_->set_behaviour(silent);
    } else if (command == "damaged") {
      server_->set_behaviour(damaged);
    } else if (command == "truncated") {
      server_->set_behaviour(truncated);
    } else {
      return false;
    }
    return true;
  }

  Options options_;
  PseudoSerialLine pseudo_;
  std::unique_ptr<Ft300Server> server_;  // ends before its line
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
  Simulator simulator(options);
  if (const Status status = simulator.plug(); !status) {
    std::fprintf(stderr, "ft300_simulator: %s\n", status.cause());
    return 1;
  }
  std::puts(simulator.line_name());
  std::fflush(stdout);
  char line[128];
  while (std::fgets(line, sizeof(line), stdin) != nullptr) {
    std::puts(simulator.answer(line).c_str());
    std::fflush(stdout);
  }
  while (true) pause();
}
