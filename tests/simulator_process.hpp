// A simulator as another process, with a conversation over its standard input and output.
#pragma once

#include <sys/types.h>

#include <string>
#include <string_view>
#include <vector>

namespace flexrf {

/// For a program that says a line once it runs, and from then on answers each line with one. One thread,
/// which outlives it: the process ends with this object, with that thread and with the test's process.
class SimulatorProcess {
 public:
  /// `arguments`: of its command line, without the program. Waits for its first line, up to 10 min.
  SimulatorProcess(const std::string& executable, const std::vector<std::string>& arguments);
  ~SimulatorProcess();
  SimulatorProcess(const SimulatorProcess&) = delete;
  SimulatorProcess& operator=(const SimulatorProcess&) = delete;

  /// It said that it runs, and kill() did not end it.
  bool is_running() const { return process_ > 0 && !first_line_.empty(); }
  /// What it said when it ran, as where it is to be found; empty: it does not run.
  const std::string& first_line() const { return first_line_; }
  /// Its answer; empty when none comes within 30 s, or it has ended.
  std::string ask(std::string_view line);

  /// As a machine that stands still: alive, and it does nothing until it is resumed.
  void pause();
  void resume();
  /// As a machine that loses its power.
  void kill();

 private:
  std::string read_line(int milliseconds);

  pid_t process_ = -1;
  int conversation_ = -1;
  std::string read_;
  std::string first_line_;
};

}  // namespace flexrf
