#include "benchmarks/program.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace flexrf::bench {
namespace {

[[noreturn]] void become_logged(const std::vector<std::string>& arguments, const std::string& log) {
  const int input = open("/dev/null", O_RDONLY | O_CLOEXEC);
  const int output = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  dup2(input, STDIN_FILENO);
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
  become(arguments);
}

}  // namespace

void become(const std::vector<std::string>& arguments) {
  std::vector<char*> pointers;
  for (const std::string& argument : arguments) pointers.push_back(const_cast<char*>(argument.c_str()));
  pointers.push_back(nullptr);
  execvp(pointers[0], pointers.data());
  std::perror(pointers[0]);
  _exit(127);
}

ProgramRun run_program(const std::vector<std::string>& arguments, const std::string& log) {
  ProgramRun run;
  const Time begin = MonotonicClock::now();
  const pid_t child = fork();
  if (child == 0) become_logged(arguments, log);
  int status = 0;
  rusage usage{};
  if (child < 0 || wait4(child, &status, 0, &usage) != child) return run;
  run.wall_time = MonotonicClock::now() - begin;
  run.greatest_memory_mib = static_cast<double>(usage.ru_maxrss) / 1024;
  if (WIFEXITED(status)) run.exit_code = WEXITSTATUS(status);
  return run;
}

std::optional<RunFigures> read_report(const std::string& file) {
  std::ifstream stream{file};
  const nlohmann::json report = stream ? nlohmann::json::parse(stream, nullptr, false) : nlohmann::json{};
  if (!report.contains("run") || !report.contains("memory")) return std::nullopt;
  const nlohmann::json& run = report["run"];
  const auto duration = [&run](const char* name) { return Duration{run.value(name, std::int64_t{0})}; };
  return RunFigures{duration("run_time_ns"), duration("wall_time_ns"), duration("start_time_ns"),
                    report["memory"].value("locked_bytes", 0.0) / (1024 * 1024),
                    run.value("realtime", false)};
}

void show_log(const std::string& log) {
  std::ifstream stream{log};
  for (std::string line; std::getline(stream, line);) std::fprintf(stderr, "  %s\n", line.c_str());
}

TemporaryFolder::TemporaryFolder() {
  const char* parent = std::getenv("TMPDIR");
  path_ = std::string{parent == nullptr ? "/var/tmp" : parent} + "/flexrf-bench.XXXXXX";
  if (mkdtemp(path_.data()) == nullptr) {
    std::perror(path_.c_str());
    std::exit(1);
  }
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace flexrf::bench
