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
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>

#include "hal/driver/simulator/simulator_program.hpp"
#include "hal/force_torque/net_ft/simulator/net_ft_server.hpp"

namespace flexrf {
namespace {

class NetFtSimulator final : public SimulatorProgram {
 public:
  bool read(CommandLine& line) override {
    line.number("--port", 0, 65535, port_);
    line.number("--rate", 1, 8000, rate_);
    return true;
  }
  Status begin() override { return server_.emplace(rate_).plug(static_cast<std::uint16_t>(port_)); }
  std::string place() const override { return "127.0.0.1 port " + std::to_string(server_->port()); }

  std::string answer(const std::string& line) override {
    char word[16] = "";
    if (std::sscanf(line.c_str(), "%15s", word) != 1) return no_command;
    const std::string_view command = word;
    const char* const rest = std::strstr(line.c_str(), word) + command.size();
    if (command == "unplug") {
      server_->unplug();
    } else if (command == "plug") {
      if (!server_->plug()) return "its port is taken";
    } else if (command == "force" || command == "torque") {
      auto& values = command == "force" ? force_ : torque_;
      if (std::sscanf(rest, "%lf %lf %lf", &values[0], &values[1], &values[2]) != 3)
        return "three numbers are needed";
      server_->with_model([this](NetFtModel& model) { model.set_load(force_, torque_); });
    } else if (command == "off") {
      server_->with_model([](NetFtModel& model) { model.switch_off_and_on(); });
    } else if (command == "status") {
      const auto status = static_cast<std::uint32_t>(std::strtoul(rest, nullptr, 16));
      server_->with_model([status](NetFtModel& model) { model.set_status(status); });
    } else if (command == "lose") {
      const auto number = static_cast<std::uint32_t>(std::strtoul(rest, nullptr, 10));
      server_->with_model([number](NetFtModel& model) { model.lose(number); });
    } else {
      return behave(command) ? "ok" : no_command;
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
      server_->with_model([wanted = behaviour](NetFtModel& model) { model.set_behaviour(wanted); });
      return true;
    }
    return false;
  }

  double port_ = rdt::usual_port;
  double rate_ = 1000;
  std::optional<NetFtServer> server_;
  std::array<double, 3> force_{};
  std::array<double, 3> torque_{};
};

}  // namespace
}  // namespace flexrf

int main(int count, char** words) {
  flexrf::NetFtSimulator simulator;
  return run_simulator(simulator, "net_ft_simulator", "usage: net_ft_simulator [--port N] [--rate HERTZ]\n",
                       count, words);
}
