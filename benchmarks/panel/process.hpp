// A program that runs beside the benchmark, and what its threads use.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/time.hpp"

namespace flexrf::bench {

/// Standard input stays open and silent; standard output and error go to `log`.
class Process {
 public:
  struct Settings {
    std::vector<std::string> arguments;    ///< the first is the program
    std::vector<std::string> environment;  ///< NAME=VALUE, added
    std::string log;
    int cpu = -1;  ///< all of it stays there; -1: wherever it likes
  };

  explicit Process(const Settings& settings);
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process();  ///< stop()

  bool is_running();
  /// Interrupts it, and kills it after 5 s; its exit code, -1 where a signal ended it.
  int stop();
  pid_t id() const noexcept { return id_; }

  /// Kernel's numbers of its threads with this name; all for an empty one.
  std::vector<pid_t> threads(std::string_view name = {}) const;
  /// CPU time of these threads so far.
  Duration cpu_time(std::string_view thread_name = {}) const;
  /// Keeps the threads with this name on one CPU.
  void pin(std::string_view thread_name, int cpu) const;
  /// "VmRSS" or another line of its status, in kB; 0 when it is gone.
  double status_kilobytes(std::string_view line) const;

 private:
  void reap(int options);

  pid_t id_ = -1;
  int input_ = -1;
  int status_ = 0;
  bool ended_ = false;
};

/// Standard output of a program that runs on this CPU; nothing when it failed.
std::optional<std::string> output_of(const std::vector<std::string>& arguments, int cpu);

/// Whether there is such a program on the PATH or among what only root runs; its path.
std::optional<std::string> find_program(const char* name);

std::string contents_of(const std::string& file);

/// A port of loopback that was free a moment ago.
int free_port();

}  // namespace flexrf::bench
