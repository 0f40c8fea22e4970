// The program robotiq_simulator as a process of its own: the far end of a serial line.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace flexrf {

class RobotiqSimulatorProcess {
 public:
  /// `words`: of its command line, without the program.
  explicit RobotiqSimulatorProcess(const std::vector<std::string>& words);
  RobotiqSimulatorProcess(const RobotiqSimulatorProcess&) = delete;
  RobotiqSimulatorProcess& operator=(const RobotiqSimulatorProcess&) = delete;
  ~RobotiqSimulatorProcess();

  /// The name of its line; empty when it did not begin.
  const std::string& line() const { return line_; }
  /// What it answers to a command; empty when it does not.
  std::string ask(const std::string& command);

 private:
  std::string read_line();

  int input_ = -1;   // to it
  int output_ = -1;  // from it
  pid_t id_ = -1;
  std::string line_;
};

}  // namespace flexrf
