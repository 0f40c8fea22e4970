// How much faster than the wall clock the keyboard application lives in virtual time.
#include <fstream>

#include "benchmarks/harness.hpp"
#include "benchmarks/program.hpp"
#include "places.hpp"

namespace flexrf::bench {
namespace {

constexpr int simulated_seconds = 60;

/// A key press every quarter of a second: there and back along each axis, so that the arm moves all the time
/// and meets no limit.
void write_keys(const std::string& file) {
  constexpr char keys[] = "wwssaaddqqee";
  std::ofstream stream{file};
  for (int press = 0; press < simulated_seconds * 4 - 1; ++press) {
    stream << 0.25 * (press + 1) << ' ' << keys[static_cast<std::size_t>(press) % (sizeof(keys) - 1)] << '\n';
  }
}

int run(int argument_count, char** arguments) {
  Report report{"virtual_time", argument_count, arguments};
  const TemporaryFolder folder;
  const std::string keys = folder.file("keys");
  const std::string log = folder.file("log");
  const std::string result = folder.file("report.json");
  write_keys(keys);
  const std::vector<std::string> command{place::keyboard,
                                         "--virtual-time",
                                         text("%ds", simulated_seconds),
                                         "--keys",
                                         keys,
                                         "--seed",
                                         "1",
                                         "--panel",
                                         "off",
                                         "--report",
                                         result};
  std::vector<double> within;
  std::vector<double> whole;
  for (int i = 0; i < report.choose(20, 5); ++i) {
    const ProgramRun program = run_program(command, log);
    const std::optional<RunFigures> figures = read_report(result);
    if (!program.succeeded() || !figures) {
      std::fprintf(stderr, "virtual_time: the application ended with %d:\n", program.exit_code);
      show_log(log);
      return 1;
    }
    within.push_back(seconds(figures->run_time) / seconds(figures->wall_time));
    whole.push_back(seconds(figures->run_time) / seconds(program.wall_time));
  }
  report.add(
      {"virtual time for keyboard against the wall clock", "x", estimate(within), 2000, true,
       text("%d s with 4 key presses a second, preparation and report's data included", simulated_seconds),
       true});
  report.add({"the same, from starting the process to its end", "x", estimate(whole), 0, false, ""});
  return report.finish();
}

}  // namespace
}  // namespace flexrf::bench

int main(int argument_count, char** arguments) {
  return flexrf::bench::run(argument_count, arguments);
}
