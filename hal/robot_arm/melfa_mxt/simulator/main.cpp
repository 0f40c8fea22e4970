// mxt_simulator: a MELFA controller in real-time external control to try a cell with, at a UDP port.
//
//   mxt_simulator [--address A] [--port N] [--joints N] [--start RAD[,RAD]...] [--speed RAD_PER_SECOND[,...]]
//                 [--cycle SECONDS] [--once]
//
// --start, --speed: of all joints, or of each. --once: its program does not come to MXT again after the end
// of a session. Says its port, then takes commands from standard input, a line each, and answers each by a
// line; "help" tells which. Runs until it is interrupted.
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>
#include <string_view>

#include "base/standard_descriptors.hpp"
#include "hal/robot_arm/melfa_mxt/simulator/mxt_console.hpp"
#include "hal/robot_arm/melfa_mxt/simulator/mxt_server.hpp"

namespace {

using namespace flexrf;
using namespace flexrf::melfa;

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

struct Options {
  const char* address = "127.0.0.1";
  double port = usual_port;
  double joints = 6;
  double cycle = 0.00711;
  JointAngles start{};
  JointAngles speed = of_all_joints(6);
  bool once = false;
};

bool is_number(const char* text, double least, double most, double& value) {
  char* end = nullptr;
  value = std::strtod(text, &end);
  return end != text && *end == '\0' && value >= least && value <= most;
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

bool parse(int count, char** words, Options& options) {
  for (int i = 1; i < count; ++i) {
    const std::string_view word = words[i];
    if (word == "--once") {
      options.once = true;
      continue;
    }
    if (++i == count) return false;
    if (word == "--address") {
      options.address = words[i];
    } else if (word == "--port") {
      if (!is_number(words[i], 0, 65535, options.port)) return false;
    } else if (word == "--joints") {
      if (!is_number(words[i], 1, most_joints, options.joints)) return false;
    } else if (word == "--start") {
      if (!are_numbers(words[i], -most_angle, most_angle, options.start)) return false;
    } else if (word == "--speed") {
      if (!are_numbers(words[i], 0.01, most_speed, options.speed)) return false;
    } else if (word == "--cycle") {
      if (!is_number(words[i], 0.001, 1, options.cycle)) return false;
    } else {
      return false;
    }
  }
  return true;
}

}  // namespace

int main(int count, char** words) {
  flexrf::hold_standard_descriptors();
  Options options;
  if (!parse(count, words, options)) {
    std::fputs(usage, stderr);
    return 2;
  }
  ControllerPlan plan;
  plan.joints = static_cast<std::size_t>(options.joints);
  plan.start = options.start;
  plan.fastest = options.speed;
  plan.cycle = options.cycle;
  plan.loops = !options.once;
  auto server = MxtServer::open(plan, true, options.address, static_cast<std::uint16_t>(options.port));
  if (!server) {
    std::fprintf(stderr, "mxt_simulator: %s\n", server.status().cause());
    return 1;
  }
  std::printf("%u\n", unsigned{(*server)->port()});
  std::fflush(stdout);
  for (std::string line; std::getline(std::cin, line);) {
    std::cout << (*server)->with([&line](MxtWire& wire) { return obey(wire, line); }) << std::endl;
  }
  while (true) pause();
}
