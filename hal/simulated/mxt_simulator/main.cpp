// mxt_simulator: a MELFA controller in real-time external control to try a cell with, at a UDP port.
//
//   mxt_simulator [--address A] [--port N] [--joints N] [--speed RAD_PER_SECOND] [--cycle SECONDS] [--once]
//
// --once: its program does not come to MXT again after the end of a session. Says its port, then takes
// commands from standard input, a line each, and answers each by a line:
//
//   joints             where the arm is, rad
//   alarm | reset      why it stopped; without alarm again, its program at MXT
//   ends               how many sessions were ended
//   trip               a drive trips: an alarm, and no more answers
//   silence | well     its cable is out, or in again
//   drop N | lose N    so many of its answers are lost, or packets to it
//   delay N            so many of its answers come with the one after them
//   foreign KIND       one datagram more: stranger, short, long, number, nonsense
//
// Runs until it is interrupted.
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

#include "hal/simulated/mxt_simulator/mxt_server.hpp"

namespace {

using namespace flexrf;
using namespace flexrf::melfa;

constexpr const char* usage =
    "usage: mxt_simulator [--address A] [--port N] [--joints N] [--speed RAD_PER_SECOND] [--cycle SECONDS] "
    "[--once]\n";

struct Options {
  const char* address = "127.0.0.1";
  double port = usual_port;
  double joints = 6;
  double speed = 6;
  double cycle = 0.00711;
  bool once = false;
};

bool is_number(const char* text, double least, double most, double& value) {
  char* end = nullptr;
  value = std::strtod(text, &end);
  return end != text && *end == '\0' && value >= least && value <= most;
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
    } else if (word == "--speed") {
      if (!is_number(words[i], 0.01, 100, options.speed)) return false;
    } else if (word == "--cycle") {
      if (!is_number(words[i], 0.001, 1, options.cycle)) return false;
    } else {
      return false;
    }
  }
  return true;
}

std::string joints_of(MxtWire& wire) {
  std::string line;
  for (const double joint : wire.controller().measured()) {
    line += (line.empty() ? "" : " ") + std::to_string(joint);
  }
  return line;
}

bool add_foreign(MxtWire& wire, std::string_view kind) {
  constexpr std::string_view kinds[] = {"stranger", "short", "long", "number", "nonsense"};
  for (std::size_t i = 0; i < std::size(kinds); ++i) {
    if (kind != kinds[i]) continue;
    wire.add_foreign(static_cast<Foreign>(i));
    return true;
  }
  return false;
}

bool obeys(MxtWire& wire, std::string_view command, const char* word) {
  const int number = std::atoi(word);
  if (command == "reset") {
    wire.controller().reset();
  } else if (command == "trip") {
    wire.controller().trip();
  } else if (command == "silence" || command == "well") {
    wire.set_silent(command == "silence");
  } else if (command == "drop" && number > 0) {
    wire.lose_answers(number);
  } else if (command == "lose" && number > 0) {
    wire.lose_packets(number);
  } else if (command == "delay" && number > 0) {
    wire.delay_answers(number);
  } else {
    return command == "foreign" && add_foreign(wire, word);
  }
  return true;
}

std::string answer(MxtWire& wire, const char* line) {
  char command[16] = "";
  char word[16] = "";
  if (std::sscanf(line, "%15s %15s", command, word) < 1) return "that is no command";
  const std::string_view said = command;
  if (said == "joints") return joints_of(wire);
  if (said == "alarm") return wire.controller().alarm()[0] == '\0' ? "none" : wire.controller().alarm();
  if (said == "ends") return std::to_string(wire.controller().ends());
  return obeys(wire, said, word) ? "ok" : "that is no command";
}

}  // namespace

int main(int count, char** words) {
  Options options;
  if (!parse(count, words, options)) {
    std::fputs(usage, stderr);
    return 2;
  }
  ControllerPlan plan;
  plan.joints = static_cast<std::size_t>(options.joints);
  plan.fastest.fill(options.speed);
  plan.cycle = options.cycle;
  plan.loops = !options.once;
  auto server = MxtServer::open(plan, true, options.address, static_cast<std::uint16_t>(options.port));
  if (!server) {
    std::fprintf(stderr, "mxt_simulator: %s\n", server.status().cause());
    return 1;
  }
  std::printf("%u\n", unsigned{(*server)->port()});
  std::fflush(stdout);
  char line[128];
  while (std::fgets(line, sizeof(line), stdin) != nullptr) {
    const std::string said = (*server)->with([&line](MxtWire& wire) { return answer(wire, line); });
    std::puts(said.c_str());
    std::fflush(stdout);
  }
  while (true) pause();
}
