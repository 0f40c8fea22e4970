// How long the keyboard application takes from its start to its first step, in real time with all memory
// locked.
#include <fstream>

#include "benchmarks/harness.hpp"
#include "benchmarks/program.hpp"
#include "places.hpp"

namespace flexrf::bench {
namespace {

int run(int argument_count, char** arguments) {
  Report report{"start", argument_count, arguments};
  const TemporaryFolder folder;
  const std::string keys = folder.file("keys");
  const std::string log = folder.file("log");
  const std::string result = folder.file("report.json");
  std::ofstream{keys} << "0.05 w\n";
  const std::vector<std::string> command{place::keyboard, "--keys",   keys,  "--panel",
                                         "off",           "--report", result};
  std::vector<double> milliseconds;
  std::vector<double> locked;
  bool realtime = true;
  for (int i = 0; i < report.choose(20, 5); ++i) {
    const ProgramRun program = run_program(command, log);
    const std::optional<RunFigures> figures = read_report(result);
    if (!program.succeeded() || !figures) {
      std::fprintf(stderr, "start: the application ended with %d:\n", program.exit_code);
      show_log(log);
      return 1;
    }
    // What the application cannot see of itself, loading before and unloading after, is counted in full.
    const Duration outside = program.wall_time - figures->wall_time;
    milliseconds.push_back(seconds(figures->start_time + outside) * 1e3);
    locked.push_back(figures->locked_mib);
    realtime = realtime && figures->realtime;
  }
  const double mebibytes = quantile(locked, 0.5);
  report.add({"start to first step", "ms", estimate(milliseconds), 50 + 0.5 * mebibytes, true,
              text("keyboard, %.1f MiB locked%s; loading included", mebibytes,
                   realtime ? "" : ", not real-time: the right is missing")});
  return report.finish();
}

}  // namespace
}  // namespace flexrf::bench

int main(int argument_count, char** arguments) {
  return flexrf::bench::run(argument_count, arguments);
}
