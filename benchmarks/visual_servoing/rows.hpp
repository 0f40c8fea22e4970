// The parts of the benchmark of the cell that picks what it sees. Each runs programs of its own, adds its
// rows, and tells false when something could not be measured, said why on standard error.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/harness.hpp"
#include "benchmarks/program.hpp"

namespace flexrf::bench {

using Json = nlohmann::ordered_json;

bool measure_picks(Report& report);
/// While a person changes light, obstacles and parts, and covers the lens, at random.
bool measure_picks_among_disturbances(Report& report);
bool measure_virtual_time(Report& report);
/// Processor time of a picture, latency, allocations, pictures with fewer CPUs, and back-off.
bool measure_by_the_wall(Report& report);
bool measure_control_thread(Report& report);

/// What the program wrote into the file that is its first argument, run on the first so many CPUs (0: all) or
/// on one of them; nothing, and its output shown, when it failed.
struct OnCpus {
  int first = 0;
  int count = 0;
};
std::optional<Json> result_of(const char* program, std::vector<std::string> arguments, OnCpus cpus = {});

/// Wilson's score interval of a share, 95 %.
Estimate wilson(double successes, double trials);

/// A row of a value without an interval.
Row plain_row(std::string what, std::string unit, double value, std::string note = "");
/// The same with a goal that is at most, or at least, this.
Row with_goal(Row row, double goal, Goal kind = Goal::at_most);

}  // namespace flexrf::bench
