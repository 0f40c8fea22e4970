// cia402_simulator as another process, with a conversation over its standard input and output.
#pragma once

#include <sys/types.h>

#include <string>
#include <string_view>

namespace flexrf {

class SimulatorProcess {
 public:
  /// Of this executable on this interface; `option` is one more word, or null.
  SimulatorProcess(const char* executable, const char* interface, const char* node,
                   const char* option = nullptr);
  /// Ends it.
  ~SimulatorProcess();
  SimulatorProcess(const SimulatorProcess&) = delete;
  SimulatorProcess& operator=(const SimulatorProcess&) = delete;

  /// It said that it runs.
  bool is_running() const { return running_; }
  /// Its answer; empty when none comes within 30 s.
  std::string ask(std::string_view line);

 private:
  std::string read_line();

  pid_t process_ = -1;
  int to_ = -1;
  int from_ = -1;
  std::string read_;
  bool running_ = false;
};

}  // namespace flexrf
