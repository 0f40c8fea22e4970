// SimulatorProgram: a program that simulates a device to try a cell with.
#pragma once

#include <string>

#include "base/status.hpp"
#include "hal/driver/simulator/command_line.hpp"

namespace flexrf {

/// What differs between them. One thread.
class SimulatorProgram {
 public:
  virtual ~SimulatorProgram() = default;

  /// Takes its options. False: they are not to be had together.
  virtual bool read(CommandLine& line) = 0;
  virtual Status begin() = 0;
  /// Where it is to be found.
  virtual std::string place() const = 0;
  /// Does what a line of standard input says; what is answered, without an end of line.
  virtual std::string answer(const std::string& line) = 0;

  static constexpr const char* no_command = "that is no command";
};

/// Says its place, then takes lines from standard input and answers each by a line. Runs until it is
/// interrupted; returns what main() does where it cannot begin.
int run_simulator(SimulatorProgram& program, const char* name, const char* usage, int count, char** words);

}  // namespace flexrf
