// What a real-time thread on a CPU of its own notices of the panel on the other.
#include <atomic>
#include <memory>
#include <thread>

#include "benchmarks/panel/cell.hpp"
#include "benchmarks/panel/http_load.hpp"
#include "benchmarks/panel/live_load.hpp"
#include "benchmarks/panel/rows.hpp"
#include "places.hpp"

namespace flexrf::bench {
namespace {

using namespace std::chrono_literals;

struct Lateness {
  double p50_us = 0;
  double p99_us = 0;
};

/// Server, clients and all that asks are on the CPU that is not the thread's.
class Load {
 public:
  Load(const Cell& cell, int cpu, int seconds) : cell_(cell), cpu_(cpu), seconds_(seconds) {}
  ~Load() {
    if (requests_.joinable()) requests_.join();
  }

  bool begin() {
    const int port = cell_.port();
    if (!values_.begin({port, cell_.session(), 100, false, R"([{"name":"block","rate":50}])", {}, cpu_}) ||
        !pictures_.begin(
            {port, cell_.session(), 10, false, R"([{"name":"picture","rate":15,"width":640}])", {}, cpu_})) {
      return false;
    }
    requests_ = std::thread{[this] {
      has_asked_ =
          run_wrk(cell_.port(), "/api/v1/slots/reading", cell_.session(), seconds_, 10, cpu_).has_value();
    }};
    return true;
  }
  /// After the requests came to their end: false, they could not be made.
  bool end() {
    requests_.join();
    return has_asked_;
  }

 private:
  const Cell& cell_;
  int cpu_;
  int seconds_;
  LiveLoad values_;
  LiveLoad pictures_;
  std::thread requests_;
  bool has_asked_ = false;
};

std::optional<Lateness> run_block(bool with_panel, const Machine& machine, int seconds) {
  Cell cell{{place::panel_load, {}, with_panel}};
  if (!cell.begin()) return std::nullopt;
  std::optional<Load> load;
  if (with_panel) {
    cell.process().pin("panel", machine.server_cpu);
    cell.process().pin("panel-pictures", machine.server_cpu);
    load.emplace(cell, machine.server_cpu, seconds + 2);
    if (!load->begin()) return std::nullopt;
  }
  std::this_thread::sleep_for(1s);
  Recording& recording = cell.recording();
  const std::uint64_t begin = recording.releases;
  std::this_thread::sleep_for(std::chrono::seconds{seconds});
  const std::uint64_t end = recording.releases;
  std::vector<double> microseconds;
  for (std::uint64_t i = begin; i < end; ++i) {
    microseconds.push_back(static_cast<double>(recording.lateness[i]) * 1e-3);
  }
  if (load && !load->end()) return std::nullopt;
  if (microseconds.size() < static_cast<std::size_t>(seconds) * 500) return std::nullopt;
  return Lateness{quantile(microseconds, 0.5), quantile(microseconds, 0.99)};
}

}  // namespace

bool measure_lateness(Report& report, const Machine& machine) {
  const NoDeepIdle no_deep_idle;
  const int blocks = report.choose(10, 3);
  const int seconds = report.choose(10, 1);
  Pairs p50;
  Pairs p99;
  for (int block = 0; block < blocks; ++block) {
    std::optional<Lateness> sides[2];  // with the panel, without
    for (const int turn : {0, 1}) {
      const bool with_panel = (turn + block) % 2 == 0;
      sides[with_panel ? 0 : 1] = run_block(with_panel, machine, seconds);
    }
    if (!sides[0] || !sides[1]) {
      std::fputs("panel: the application gave no measurement of its lateness\n", stderr);
      return false;
    }
    p50.add(sides[0]->p50_us, sides[1]->p50_us);
    p99.add(sides[0]->p99_us, sides[1]->p99_us);
  }
  const std::string conditions =
      text("%d blocks of %d s each; 100 clients of values, 10 of pictures, requests", blocks, seconds);
  report.add_ratio("lateness of a 1 ms thread, panel under load on the other CPU, p50", p50, 1.05, "us",
                   conditions);
  report.add_ratio("lateness of a 1 ms thread, panel under load on the other CPU, p99", p99, 1.2, "us",
                   conditions);
  return true;
}

}  // namespace flexrf::bench
