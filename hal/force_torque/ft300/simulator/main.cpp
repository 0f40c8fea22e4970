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
#include <cstdio>
#include <cstring>
#include <string_view>

#include "hal/force_torque/ft300/simulator/ft300_server.hpp"
#include "hal/modbus/link/simulator/serial_simulator.hpp"

namespace flexrf {
namespace {

class Ft300Simulator final : public SerialSimulator {
 public:
  bool read(CommandLine& line) override {
    line.number("--unit", 1, 247, unit_);
    return use_line(line, line.word("--serial"));
  }

 private:
  Status plug() override {
    const auto unit = static_cast<std::uint8_t>(unit_);
    auto server = is_pseudo_terminal() ? Ft300Server::on_descriptor(descriptor(), unit)
                                       : Ft300Server::on_serial_line(device(), unit);
    if (!server) return server.status();
    server_ = std::move(*server);
    server_->set_load(force_, torque_);
    return {};
  }
  void unplug() override { server_.reset(); }

  std::string obey(const std::string& line) override {
    char word[16] = "";
    if (std::sscanf(line.c_str(), "%15s", word) != 1) return no_command;
    const std::string_view command = word;
    if (command == "force" || command == "torque") {
      auto& values = command == "force" ? force_ : torque_;
      const char* const rest = std::strstr(line.c_str(), word) + command.size();
      if (std::sscanf(rest, "%lf %lf %lf", &values[0], &values[1], &values[2]) != 3)
        return "three numbers are needed";
      if (server_ != nullptr) server_->set_load(force_, torque_);
      return "ok";
    }
    if (server_ == nullptr) return "it is unplugged";
    return behaves(command) ? "ok" : no_command;
  }

  bool behaves(std::string_view command) {
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

  double unit_ = ft300::usual_unit_id;
  std::unique_ptr<Ft300Server> server_;  // ends before its line
  std::array<double, 3> force_{};
  std::array<double, 3> torque_{};
};

}  // namespace
}  // namespace flexrf

int main(int count, char** words) {
  flexrf::Ft300Simulator simulator;
  return run_simulator(simulator, "ft300_simulator",
                       "usage: ft300_simulator (--serial DEVICE | --pseudo-terminal) [--unit N]\n", count,
                       words);
}
