#include "hal/robot_arm/melfa_mxt/simulator/mxt_console.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>

namespace flexrf::melfa {
namespace {

constexpr const char* obeyed = "ok";

std::string joints_of(const MxtWire& wire) {
  std::string line;
  for (const double joint : wire.controller().measured()) {
    line += (line.empty() ? "" : " ") + std::to_string(joint);
  }
  return line;
}

std::string add_foreign(MxtWire& wire, std::string_view kind) {
  constexpr std::string_view kinds[] = {"stranger", "short", "long", "number", "nonsense"};
  for (std::size_t i = 0; i < std::size(kinds); ++i) {
    if (kind != kinds[i]) continue;
    wire.add_foreign(static_cast<Foreign>(i));
    return obeyed;
  }
  return "a foreign datagram is stranger, short, long, number or nonsense";
}

std::string lead(MxtWire& wire, const std::string& word) {
  char* end = nullptr;
  const double way = std::strtod(word.c_str(), &end);
  if (word.empty() || *end != '\0' || !std::isfinite(way)) return "a way is written as -0.5";
  wire.controller().be_led(way);
  return obeyed;
}

std::string spoil(MxtWire& wire, std::string_view command, const std::string& word) {
  const int number = std::atoi(word.c_str());
  if (number <= 0) return "how many is a number from 1";
  if (command == "drop") wire.lose_answers(number);
  if (command == "lose") wire.lose_packets(number);
  if (command == "delay") wire.delay_answers(number);
  return obeyed;
}

}  // namespace

const char* const console_help =
    "joints             where the arm is, rad\n"
    "alarm, reset       why it stopped; without alarm again, its program at MXT\n"
    "ends               how many sessions were ended\n"
    "session            open or ended\n"
    "moves              how many positions it was told\n"
    "trip               a drive trips: an alarm, and no more answers\n"
    "silence, well      its cable is out, or in again\n"
    "drop N, lose N     so many of its answers are lost, or packets to it\n"
    "delay N            so many of its answers come with the one after them\n"
    "foreign KIND       one datagram more: stranger, short, long, number, nonsense\n"
    "led RAD            somebody else led each joint so far\n";

std::string obey(MxtWire& wire, std::string_view line) {
  const std::size_t space = std::min(line.find(' '), line.size());
  const std::string_view command = line.substr(0, space);
  const std::string word{line.substr(std::min(space + 1, line.size()))};
  const MxtController& controller = wire.controller();
  if (command == "joints") return joints_of(wire);
  if (command == "alarm") return controller.alarm()[0] == '\0' ? "none" : controller.alarm();
  if (command == "ends") return std::to_string(controller.ends());
  if (command == "session") return controller.is_in_session() ? "open" : "ended";
  if (command == "moves") return std::to_string(controller.moves());
  if (command == "help") return console_help;
  if (command == "foreign") return add_foreign(wire, word);
  if (command == "led") return lead(wire, word);
  if (command == "drop" || command == "lose" || command == "delay") return spoil(wire, command, word);
  if (command == "reset") {
    wire.controller().reset();
  } else if (command == "trip") {
    wire.controller().trip();
  } else if (command == "silence" || command == "well") {
    wire.set_silent(command == "silence");
  } else {
    return "that is no command; help tells what is known";
  }
  return obeyed;
}

}  // namespace flexrf::melfa
