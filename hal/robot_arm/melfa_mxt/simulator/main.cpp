// mxt_simulator: a MELFA controller in real-time external control to try a cell with, at a UDP port.
//
//   mxt_simulator [--address A] [--port N] [--joints N] [--start RAD[,RAD]...] [--speed RAD_PER_SECOND[,...]]
//                 [--cycle SECONDS] [--once]
//
// --start, --speed: of all joints, or of each. --once: its program does not come to MXT again after the end
// of a session. Says its port, then takes commands from standard input, a line each, and answers each by a
// line; "help" tells which. Runs until it is interrupted.
#include <algorithm>
#include <string>
#include <string_view>

#include "hal/driver/simulator/simulator_program.hpp"
#include "hal/robot_arm/melfa_mxt/simulator/mxt_console.hpp"
#include "hal/robot_arm/melfa_mxt/simulator/mxt_server.hpp"

namespace flexrf::melfa {
namespace {

constexpr const char* usage =
    "usage: mxt_simulator [--address A] [--port N] [--joints N] [--start RAD[,RAD]...]\n"
    "                     [--speed RAD_PER_SECOND[,...]] [--cycle SECONDS] [--once]\n";

constexpr double most_speed = 100;  // rad/s
constexpr double most_angle = 10;   // rad

JointAngles of_all_joints(double value) {
  JointAngles all{};
  all.fill(value);
  return all;
}

/// One number for all joints, or one for each of the first.
bool are_numbers(std::string_view text, double least, double most, JointAngles& values) {
  std::size_t joint = 0;
  for (std::string_view rest = text; joint < values.size(); ++joint) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    if (!is_number(std::string{rest.substr(0, comma)}.c_str(), least, most, values[joint])) return false;
    if (comma == rest.size()) {
      if (joint == 0) values = of_all_joints(values[0]);
      return true;
    }
    rest.remove_prefix(comma + 1);
  }
  return false;
}

class MxtSimulator final : public SimulatorProgram {
 public:
  bool read(CommandLine& line) override {
    auto joints = static_cast<double>(plan_.joints);
    plan_.fastest = of_all_joints(6);
    plan_.loops = !line.has("--once");
    if (const char* const address = line.word("--address"); address != nullptr) address_ = address;
    line.number("--port", 0, 65535, port_);
    line.number("--joints", 1, most_joints, joints);
    line.number("--cycle", 0.001, 1, plan_.cycle);
    plan_.joints = static_cast<std::size_t>(joints);
    const char* const start = line.word("--start");
    const char* const speed = line.word("--speed");
    return (start == nullptr || are_numbers(start, -most_angle, most_angle, plan_.start)) &&
           (speed == nullptr || are_numbers(speed, 0.01, most_speed, plan_.fastest));
  }
  Status begin() override {
    auto server = MxtServer::open(plan_, true, address_, static_cast<std::uint16_t>(port_));
    if (!server) return server.status();
    server_ = std::move(*server);
    return {};
  }
  std::string place() const override { return std::to_string(server_->port()); }
  std::string answer(const std::string& line) override {
    return server_->with([&line](MxtWire& wire) { return obey(wire, line); });
  }

 private:
  ControllerPlan plan_;
  const char* address_ = "127.0.0.1";
  double port_ = usual_port;
  std::unique_ptr<MxtServer> server_;
};

}  // namespace
}  // namespace flexrf::melfa

int main(int count, char** words) {
  flexrf::melfa::MxtSimulator simulator;
  return flexrf::run_simulator(simulator, "mxt_simulator", flexrf::melfa::usage, count, words);
}
