// What the cell that picks what it sees costs, and how well it picks: docs/performance.md tells what each row
// means.
#include <sched.h>

#include <cmath>
#include <fstream>
#include <thread>

#include "benchmarks/visual_servoing/rows.hpp"

namespace flexrf::bench {

std::optional<Json> result_of(const char* program, std::vector<std::string> arguments, OnCpus cpus) {
  const TemporaryFolder folder;
  std::vector<std::string> command{program, folder.file("result")};
  command.insert(command.end(), arguments.begin(), arguments.end());
  ProgramRun run;
  // A child inherits the CPUs of the thread that starts it.
  std::thread starting{[&] {
    if (cpus.count > 0) {
      cpu_set_t set;
      CPU_ZERO(&set);
      for (int i = 0; i < cpus.count; ++i) CPU_SET(static_cast<std::size_t>(cpus.first + i), &set);
      sched_setaffinity(0, sizeof(set), &set);
    }
    run = run_program(command, folder.file("log"));
  }};
  starting.join();
  std::ifstream file{folder.file("result")};
  Json result = file ? Json::parse(file, nullptr, false) : Json{};
  if (run.succeeded() && result.is_object()) return result;
  std::fprintf(stderr, "visual_servoing: %s ended with %d:\n", program, run.exit_code);
  show_log(folder.file("log"));
  return std::nullopt;
}

Estimate wilson(double successes, double trials) {
  if (trials == 0) return {0, 0, 1};
  constexpr double z = 1.959964;  // of 95 %
  const double share = successes / trials;
  const double middle = (share + z * z / (2 * trials)) / (1 + z * z / trials);
  const double half =
      z * std::sqrt(share * (1 - share) / trials + z * z / (4 * trials * trials)) / (1 + z * z / trials);
  return {share, middle - half, middle + half};
}

Row plain_row(std::string what, std::string unit, double value, std::string note) {
  Row row;
  row.what = std::move(what);
  row.unit = std::move(unit);
  row.value = {value, value, value};
  row.note = std::move(note);
  return row;
}

Row with_goal(Row row, double goal, Goal kind) {
  row.goal = goal;
  row.has_goal = true;
  row.at_least = kind == Goal::at_least;
  return row;
}

namespace {

int run(int argument_count, char** arguments) {
  Report report{"visual_servoing", argument_count, arguments};
  bool measured = measure_by_the_wall(report);
  measured = measure_virtual_time(report) && measured;
  measured = measure_picks(report) && measured;
  measured = measure_picks_among_disturbances(report) && measured;
  measured = measure_control_thread(report) && measured;
  const int exit_code = report.finish();
  return measured ? exit_code : 1;
}

}  // namespace
}  // namespace flexrf::bench

int main(int argument_count, char** arguments) {
  return flexrf::bench::run(argument_count, arguments);
}
