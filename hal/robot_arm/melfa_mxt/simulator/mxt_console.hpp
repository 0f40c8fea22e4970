// A simulated MELFA controller that is told by lines of text what shall go wrong: for tests, and for people
// at a terminal.
#pragma once

#include <string>
#include <string_view>

#include "hal/robot_arm/melfa_mxt/simulator/mxt_wire.hpp"

namespace flexrf::melfa {

/// A line for each command.
extern const char* const console_help;

/// Does what the line says; "ok", what was asked for, or what is wrong with the line. In the wire's thread,
/// or in MxtServer::with().
std::string obey(MxtWire& wire, std::string_view line);

}  // namespace flexrf::melfa
