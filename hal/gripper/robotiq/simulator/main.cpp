// robotiq_simulator: a Robotiq two-finger gripper to try a cell with.
//
//   robotiq_simulator (--serial DEVICE BAUD | --pseudo-terminal) [--unit N] [--width METRES]
//                     [--longest-step SECONDS]
//
// With a longest step its fingers stand still with the machine: no more than that passes for them between two
// requests.
//
// Says the name of its line, then takes commands from standard input, a line each, and answers each by a
// line:
//
//   fingers            between the fingertips, in m
//   object W | around W | take       something so wide between the fingers, or around them; nothing any more
//   stuck | free       the fingers do not move, or do again
//   fault N            it reports gFLT N
//   off | on           without power; with it again, and everything forgotten
//   silent | damaged | truncated | well       how it answers from now on
//   unplug | plug      a pseudo-terminal: its adapter is pulled out; plugged in, with the line's new name
//
// Runs until it is interrupted.
#include <cstdio>
#include <optional>
#include <string_view>

#include "hal/gripper/robotiq/simulator/robotiq_model.hpp"
#include "hal/modbus/link/simulator/modbus_server.hpp"
#include "hal/modbus/link/simulator/serial_simulator.hpp"

namespace flexrf {
namespace {

class RobotiqSimulator final : public SerialSimulator {
 public:
  bool read(CommandLine& line) override {
    robotiq::ModelPlan plan;
    double longest_step = 0;  // s; 0: any
    line.number("--unit", 1, 247, unit_);
    line.number("--width", 0.001, 1, plan.open_width);
    line.number("--longest-step", 0.001, 60, longest_step);
    if (longest_step > 0) plan.longest_step = duration_of(longest_step);
    model_.emplace(plan);
    return use_line(line, line.word_and_number("--serial", 1200, 921600, baud_));
  }

 private:
  Status plug() override {
    const auto unit = static_cast<std::uint8_t>(unit_);
    auto server = is_pseudo_terminal()
                      ? ModbusServer::on_descriptor(unit, descriptor())
                      : ModbusServer::on_serial_line(unit, device(), static_cast<int>(baud_), 'N');
    if (!server) return server.status();
    server_ = std::move(*server);
    server_->set_model(&*model_);
    return {};
  }
  void unplug() override { server_.reset(); }

  std::string obey(const std::string& line) override {
    char command[16] = "";
    double number = 0;
    const int parts = std::sscanf(line.c_str(), "%15s %lf", command, &number);
    if (parts < 1 || number < 0 || number > 255) return no_command;
    if (std::string_view(command) == "fingers") return std::to_string(model_->fingers());
    return fingers_obey(command, number) || line_obeys(command) ? "ok" : no_command;
  }

  bool fingers_obey(std::string_view command, double number) {
    if (command == "object") {
      model_->put_object(number);
    } else if (command == "around") {
      model_->put_around(number);
    } else if (command == "take") {
      model_->take_away();
    } else if (command == "stuck" || command == "free") {
      model_->set_stuck(command == "stuck");
    } else if (command == "fault") {
      model_->set_fault(static_cast<std::uint8_t>(number));
    } else {
      return false;
    }
    return true;
  }

  bool line_obeys(std::string_view command) {
    if (server_ == nullptr) return false;
    if (command == "on") model_->switch_off_and_on();
    if (command == "on") command = "well";
    if (command == "off") command = "silent";
    const auto behaviour = ModbusServer::behaviour_named(command);
    if (!behaviour) return false;
    server_->set_behaviour(*behaviour);
    return true;
  }

  double unit_ = robotiq::usual_unit_id;
  double baud_ = 0;
  std::optional<robotiq::RobotiqModel> model_;
  std::unique_ptr<ModbusServer> server_;  // ends before what it answers for
};

}  // namespace
}  // namespace flexrf

int main(int count, char** words) {
  flexrf::RobotiqSimulator simulator;
  return run_simulator(simulator, "robotiq_simulator",
                       "usage: robotiq_simulator (--serial DEVICE BAUD | --pseudo-terminal) [--unit N] "
                       "[--width METRES]\n                         [--longest-step SECONDS]\n",
                       count, words);
}
