// The control thread beside vision at full load: `servoing_control FILE BLOCKS SECONDS`. Blocks of ours
// alternate with blocks of a floor, in which the thread works on another CPU, so that all else goes on, and
// on its own CPU is cyclictest, or a bare loop of equal length, with its priority and period.
#include <pthread.h>
#include <sched.h>
#include <sys/types.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "benchmarks/harness.hpp"
#include "benchmarks/visual_servoing/block_histogram.hpp"
#include "benchmarks/visual_servoing/wall_cell.hpp"

namespace flexrf::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr double warming_up = 4;  // s
// After the thread was moved: caches, and the release under way.
constexpr double settling = 0.2;  // s

struct Block {
  double p50_us = 0;
  double p99_us = 0;
  std::uint64_t cycles = 0;
  std::uint64_t over_budget = 0;
  std::uint64_t switches = 0;  // in which it had to leave its CPU to another thread

  Json json() const {
    return {{"p50_us", p50_us},
            {"p99_us", p99_us},
            {"cycles", cycles},
            {"over_budget", over_budget},
            {"switches", switches}};
  }
};

Block block_of(const BlockHistogram& lateness, const BlockHistogram* execution, Duration budget) {
  return {lateness.quantile(0.5), lateness.quantile(0.99), lateness.count(),
          execution == nullptr ? 0 : execution->above(budget)};
}

std::uint64_t involuntary_switches(const std::string& task) {
  std::ifstream file{"/proc/self/task/" + task + "/status"};
  constexpr std::string_view field = "nonvoluntary_ctxt_switches:";
  for (std::string line; std::getline(file, line);)
    if (line.starts_with(field)) return std::strtoull(line.c_str() + field.size(), nullptr, 10);
  return 0;
}

/// So many rounds of arithmetic; what they take depends on nothing but the CPU.
void work(std::uint64_t rounds) {
  std::uint64_t value = 1;
  for (std::uint64_t i = 0; i < rounds; ++i) {
    value = value * 6364136223846793005U + 1442695040888963407U;
    touch(&value);
  }
}

std::uint64_t rounds_in(Duration length) {
  constexpr std::uint64_t tried = 1'000'000;
  const double each = nanoseconds_per_call(1, [] { work(tried); }) / static_cast<double>(tried);
  return static_cast<std::uint64_t>(static_cast<double>(length.count()) / each);
}

class ControlBlocks {
 public:
  ControlBlocks(WallCell& cell, double seconds) : cell_(cell), seconds_(seconds) {
    const std::size_t thread = cell.threads("control").front();
    record_ = &cell.record(thread);
    state_ = &cell.state(thread);
    id_ = state_->thread_id;
    cpu_ = cell.control_cpus().lowest();
  }

  Block ours() {
    move_to(cell_.control_cpus());
    const std::uint64_t switches = involuntary_switches(std::to_string(id_));
    const BlockHistogram lateness_before(state_->lateness);
    const BlockHistogram execution_before(state_->execution);
    pause(seconds_);
    BlockHistogram lateness(state_->lateness);
    BlockHistogram execution(state_->execution);
    lateness.subtract(lateness_before);
    execution.subtract(execution_before);
    if (length_ == Duration{}) length_ = duration_of(execution.quantile(0.5) * 1e-6);
    Block block = block_of(lateness, &execution, record_->budget);
    block.switches = involuntary_switches(std::to_string(id_)) - switches;
    return block;
  }

  /// Nothing where it is not there or may not be real-time.
  std::optional<Block> cyclictest() {
    move_to(cell_.other_cpus());
    const std::size_t warm = static_cast<std::size_t>(settling / period());
    const std::string command =
        text("exec cyclictest -t1 -m -N -v -i %lld -p %d -a %d --mainaffinity=%d -l %zu 2>/dev/null",
             static_cast<long long>(record_->trigger.period.count() / 1000), record_->priority, cpu_,
             cell_.other_cpus().lowest(), static_cast<std::size_t>(seconds_ / period()) + warm);
    FILE* const output = popen(command.c_str(), "r");
    if (output == nullptr) return std::nullopt;
    Histogram lateness;
    char line[256];
    while (std::fgets(line, sizeof(line), output) != nullptr) {
      std::size_t cycle = 0;
      double nanoseconds = 0;
      if (std::sscanf(line, "%*d: %zu: %lf", &cycle, &nanoseconds) == 2 && cycle >= warm)
        lateness.add(Duration{static_cast<std::int64_t>(nanoseconds)});
    }
    if (pclose(output) != 0 || lateness.count() == 0) return std::nullopt;
    return block_of(BlockHistogram(lateness), nullptr, record_->budget);
  }

  /// It computes in each period for as long as the control thread's median cycle.
  Block bare_loop() {
    move_to(cell_.other_cpus());
    Block block;
    std::thread loop{[&] {
      settle_thread(cpu_, record_->priority);
      block = loop_through();
    }};
    loop.join();
    return block;
  }

  /// Of our other threads, those that may run on its CPU: only they can delay it.
  std::size_t sharers() const {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator("/proc/self/task")) {
      const int task = std::atoi(entry.path().filename().c_str());
      cpu_set_t set;
      if (task != id_ && sched_getaffinity(task, sizeof(set), &set) == 0 && CpuSet(set).contains(cpu_))
        ++count;
    }
    return count;
  }
  Json conditions() const {
    return {{"cpu", cpu_},
            {"priority", record_->priority},
            {"period_ms", period() * 1e3},
            {"budget_us", flexrf::seconds(record_->budget) * 1e6},
            {"bare_loop_us", flexrf::seconds(length_) * 1e6}};
  }

 private:
  double period() const { return flexrf::seconds(record_->trigger.period); }

  void move_to(const CpuSet& cpus) {
    sched_setaffinity(id_, sizeof(cpu_set_t), &cpus.mask());
    pause(settling);
  }

  Block loop_through() const {
    Histogram lateness;
    Histogram execution;
    const std::uint64_t rounds = rounds_in(length_);
    const std::string task = std::to_string(gettid());
    const std::uint64_t switches = involuntary_switches(task);
    Time release = MonotonicClock::now() + record_->trigger.period;
    const Time end = release + duration_of(seconds_);
    for (; release < end; release += record_->trigger.period) {
      const std::int64_t at = release.time_since_epoch().count();
      const timespec until{static_cast<time_t>(at / 1'000'000'000), static_cast<long>(at % 1'000'000'000)};
      clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
      const Time began = MonotonicClock::now();
      work(rounds);
      lateness.add(began - release);
      execution.add(MonotonicClock::now() - began);
    }
    const BlockHistogram executions(execution);
    Block block = block_of(BlockHistogram(lateness), &executions, record_->budget);
    block.switches = involuntary_switches(task) - switches;
    return block;
  }

  WallCell& cell_;
  double seconds_;
  const ThreadRecord* record_ = nullptr;
  const ThreadState* state_ = nullptr;
  int id_ = 0;
  int cpu_ = 0;
  Duration length_{};
};

void measure(WallCell& cell, int blocks, double seconds, Json& result) {
  pause(warming_up);
  if (!cell.is_realtime()) {
    std::fputs("visual_servoing: the right to real time is missing: its control thread is not judged\n",
               stderr);
    return;
  }
  if (!cell.other_cpus().common_with(cell.control_cpus()).is_empty()) {
    std::fputs("visual_servoing: with one CPU there is no floor for the control thread\n", stderr);
    return;
  }
  ControlBlocks control(cell, seconds);
  result["sharers"] = control.sharers();
  control.ours();  // its length is the bare loop's
  Json& pairs = result["blocks"] = Json::array();
  for (int block = 0; block < blocks; ++block) {
    const bool floor_first = block / 2 % 2 == 1;
    std::optional<Block> floor;
    const auto run_floor = [&] { floor = block % 2 == 0 ? control.cyclictest() : control.bare_loop(); };
    if (floor_first) run_floor();
    const Block ours = control.ours();
    if (!floor_first) run_floor();
    Json pair{{"ours", ours.json()}};
    if (floor) pair[block % 2 == 0 ? "cyclictest" : "bare_loop"] = floor->json();
    pairs.push_back(pair);
  }
  result["conditions"] = control.conditions();
}

int run(const char* file, int blocks, double seconds) {
  const NoDeepIdle no_deep_idle;  // as cyclictest forbids it
  WallCell cell;
  Json result = Json::object();
  if (!cell.run([&] { measure(cell, blocks, seconds, result); })) return 1;
  std::ofstream(file) << result.dump(1) << '\n';
  return 0;
}

}  // namespace
}  // namespace flexrf::bench

int main(int count, char** arguments) {
  if (count == 4)
    return flexrf::bench::run(arguments[1], std::atoi(arguments[2]), std::strtod(arguments[3], nullptr));
  std::fprintf(stderr, "servoing_control FILE BLOCKS SECONDS\n");
  return 1;
}
