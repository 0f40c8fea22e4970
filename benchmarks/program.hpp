// Runs a program and says what it took: for benchmarks of whole applications, of the generator and of builds.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/time.hpp"

namespace flexrf::bench {

/// In a child process: is this program from now on, the first argument; ends where it cannot be run.
[[noreturn]] void become(const std::vector<std::string>& arguments);

struct ProgramRun {
  int exit_code = -1;              ///< -1: it could not be run, or a signal ended it
  Duration wall_time{};            ///< from before it is started to its end
  double greatest_memory_mib = 0;  ///< resident, of the greatest process among it and those it waited for
  bool succeeded() const { return exit_code == 0; }
};

/// Waits for its end. The first argument is the program; standard input is empty, standard output and error
/// go to `log`, which the caller can show when it fails.
ProgramRun run_program(const std::vector<std::string>& arguments, const std::string& log);

/// Of what an application wrote with --report.
struct RunFigures {
  Duration run_time{};    ///< simulated in virtual time
  Duration wall_time{};   ///< from main to the end
  Duration start_time{};  ///< from main to the first step
  double locked_mib = 0;
  bool realtime = false;
};
/// Nothing when there is no such file or it is not such a report.
std::optional<RunFigures> read_report(const std::string& file);

/// Copies a file to standard error.
void show_log(const std::string& log);

/// A folder that is removed with all that is in it when this object goes.
class TemporaryFolder {
 public:
  TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();
  const std::string& path() const { return path_; }
  std::string file(const char* name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

}  // namespace flexrf::bench
