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
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>

#include "base/standard_descriptors.hpp"
#include "hal/gripper/robotiq/simulator/robotiq_model.hpp"
#include "hal/modbus/link/simulator/modbus_server.hpp"
#include "hal/modbus/link/simulator/pseudo_serial_line.hpp"

namespace {

using namespace flexrf;

constexpr const char* usage =
    "usage: robotiq_simulator (--serial DEVICE BAUD | --pseudo-terminal) [--unit N] [--width METRES]\n"
    "                         [--longest-step SECONDS]\n";

struct Options {
  const char* device = nullptr;  // null: a pseudo-terminal
  bool pseudo_terminal = false;
  double baud = 0;
  double unit = robotiq::usual_unit_id;
  double width = 0.085;
  double longest_step = 0;  // s; 0: any
};

bool is_number(const char* text, double least, double most, double& value) {
  char* end = nullptr;
  value = std::strtod(text, &end);
  return end != text && *end == '\0' && value >= least && value <= most;
}

bool parse(int count, char** words, Options& options) {
  for (int i = 1; i < count; ++i) {
    const int left = count - i - 1;
    if (std::strcmp(words[i], "--serial") == 0 && left >= 2) {
      options.device = words[++i];
      if (!is_number(words[++i], 1200, 921600, options.baud)) return false;
    } else if (std::strcmp(words[i], "--pseudo-terminal") == 0) {
      options.pseudo_terminal = true;
    } else if (std::strcmp(words[i], "--unit") == 0 && left >= 1) {
      if (!is_number(words[++i], 1, 247, options.unit)) return false;
    } else if (std::strcmp(words[i], "--width") == 0 && left >= 1) {
      if (!is_number(words[++i], 0.001, 1, options.width)) return false;
    } else if (std::strcmp(words[i], "--longest-step") == 0 && left >= 1) {
      if (!is_number(words[++i], 0.001, 60, options.longest_step)) return false;
    } else {
      return false;
    }
  }
  return options.pseudo_terminal != (options.device != nullptr);
}

robotiq::ModelPlan plan_of(const Options& options) {
  robotiq::ModelPlan plan;
  plan.open_width = options.width;
  if (options.longest_step > 0) plan.longest_step = duration_of(options.longest_step);
  return plan;
}

class Simulator {
 public:
  explicit Simulator(const Options& options) : options_(options), model_(plan_of(options)) {}

  Status plug() {
    if (options_.pseudo_terminal) {
      if (const Status status = pseudo_.open(); !status) return status;
    }
    const auto unit = static_cast<std::uint8_t>(options_.unit);
    auto server = options_.pseudo_terminal ? ModbusServer::on_descriptor(unit, pseudo_.descriptor())
                                           : ModbusServer::on_serial_line(
                                                 unit, options_.device, static_cast<int>(options_.baud), 'N');
    if (!server) return server.status();
    server_ = std::move(*server);
    server_->set_model(&model_);
    return {};
  }

  /// The answer, without the end of the line.
  std::string answer(const char* line) {
    char command[16] = "";
    double number = 0;
    const int parts = std::sscanf(line, "%15s %lf", command, &number);
    if (parts < 1 || number < 0 || number > 255) return "that is no command";
    if (std::strcmp(command, "fingers") == 0) return std::to_string(model_.fingers());
    if (std::strcmp(command, "unplug") == 0 && options_.pseudo_terminal) {
      server_.reset();
      pseudo_.close();
      return "ok";
    }
    if (std::strcmp(command, "plug") == 0 && options_.pseudo_terminal) {
      const Status status = plug();
      return status ? line_name() : status.cause();
    }
    return fingers_obey(command, number) || line_obeys(command) ? "ok" : "that is no command";
  }
  const char* line_name() const {
    return options_.pseudo_terminal ? pseudo_.path().c_str() : options_.device;
  }

 private:
  bool fingers_obey(std::string_view command, double number) {
    if (command == "object") {
      model_.put_object(number);
    } else if (command == "around") {
      model_.put_around(number);
    } else if (command == "take") {
      model_.take_away();
    } else if (command == "stuck" || command == "free") {
      model_.set_stuck(command == "stuck");
    } else if (command == "fault") {
      model_.set_fault(static_cast<std::uint8_t>(number));
    } else {
      return false;
    }
    return true;
  }

  bool line_obeys(std::string_view command) {
    if (server_ == nullptr) return false;
    if (command == "on") model_.switch_off_and_on();
    if (command == "on") command = "well";
    if (command == "off") command = "silent";
    const auto behaviour = ModbusServer::behaviour_named(command);
    if (!behaviour) return false;
    server_->set_behaviour(*behaviour);
    return true;
  }

  Options options_;
  robotiq::RobotiqModel model_;
  PseudoSerialLine pseudo_;
  std::unique_ptr<ModbusServer> server_;  // ends before what it answers for
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
    std::fprintf(stderr, "robotiq_simulator: %s\n", status.cause());
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
