// How long the generator takes for large applications, and the compiler for what it writes.
#include <filesystem>

#include "benchmarks/harness.hpp"
#include "benchmarks/program.hpp"
#include "benchmarks/scale_tables.hpp"
#include "places.hpp"

namespace flexrf::bench {
namespace {

constexpr int outputs_of_each = 2;

/// Runs a program that has to succeed; false, and said why, when it does not.
bool run_or_say(const std::vector<std::string>& arguments, const std::string& log, ProgramRun& run) {
  run = run_program(arguments, log);
  if (run.succeeded()) return true;
  std::fprintf(stderr, "generator: '%s' ended with %d:\n", arguments[0].c_str(), run.exit_code);
  show_log(log);
  return false;
}

bool measure_generator(Report& report, const std::string& folder, const std::string& log) {
  constexpr int units = 1000;
  if (!write_scale_tables(folder, units, outputs_of_each)) return false;
  std::vector<double> seconds_taken;
  for (int i = 0; i < report.choose(20, 3); ++i) {
    const std::string output = folder + text("/output-%d", i);
    ProgramRun run;
    if (!run_or_say({place::config_gen, "--application", folder + "/scale.toml", "--types", folder + "/types",
                     "--units", folder + "/units", "--output", output},
                    log, run)) {
      return false;
    }
    seconds_taken.push_back(seconds(run.wall_time));
  }
  report.add({text("generate %d units and %d slots", units, units * outputs_of_each), "s",
              estimate(seconds_taken), 1, true, "tables read, checked, everything written"});
  return true;
}

/// As an application outside of the repository is built: from an installed FlexRF.
bool measure_compiler(Report& report, const std::string& folder, const std::string& log) {
  constexpr int units = 500;
  const std::string prefix = folder + "/prefix";
  const std::string build = folder + "/build";
  ProgramRun run;
  if (!write_scale_tables(folder, units, outputs_of_each) ||
      !run_or_say({"cmake", "--install", place::build, "--prefix", prefix}, log, run) ||
      !run_or_say({"cmake", "-S", folder, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=RelWithDebInfo",
                   "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O2 -g1 -DNDEBUG", "-DCMAKE_PREFIX_PATH=" + prefix},
                  log, run)) {
    return false;
  }
  std::vector<double> seconds_taken;
  double memory_mib = 0;
  for (int i = 0; i < report.choose(3, 1); ++i) {
    ProgramRun cleaning;
    if (!run_or_say({"cmake", "--build", build, "--target", "clean"}, log, cleaning) ||
        !run_or_say({"cmake", "--build", build, "--parallel", "2"}, log, run)) {
      return false;
    }
    seconds_taken.push_back(seconds(run.wall_time));
    memory_mib = std::max(memory_mib, run.greatest_memory_mib);
  }
  const double size = static_cast<double>(std::filesystem::file_size(build + "/scale")) * 1e-6;
  const std::string what = text("%d units and %d slots: ", units, units * outputs_of_each);
  report.add({what + "generate and compile on 2 cores", "s", estimate(seconds_taken), 60, true,
              "from an installed FlexRF, -O2 -g1"});
  report.add(
      {what + "greatest compiler process", "MiB", {memory_mib, memory_mib, memory_mib}, 1024, true, ""});
  report.add({what + "executable", "MB", {size, size, size}, 20, true, "with line tables for the debugger"});
  return true;
}

int run(int argument_count, char** arguments) {
  Report report{"generator", argument_count, arguments};
  const TemporaryFolder folder;
  const std::string log = folder.file("log");
  const bool measured = measure_generator(report, folder.file("generator"), log) &&
                        measure_compiler(report, folder.file("compiler"), log);
  return measured ? report.finish() : 1;
}

}  // namespace
}  // namespace flexrf::bench

int main(int argument_count, char** arguments) {
  return flexrf::bench::run(argument_count, arguments);
}
