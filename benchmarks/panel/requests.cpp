// GET of a small value over 50 connections, against nginx with a file of the same size.
#include <thread>

#include "benchmarks/panel/cell.hpp"
#include "benchmarks/panel/http_load.hpp"
#include "benchmarks/panel/rows.hpp"
#include "places.hpp"

namespace flexrf::bench {
namespace {

using namespace std::chrono_literals;

constexpr int connections = 50;
constexpr const char* value = "slots/reading";

struct Block {
  double per_cpu_second = 0;
  double p99_us = 0;
};

template <class CpuTime>
std::optional<Block> run_block(int port, const std::string& path, const std::string& session, int seconds,
                               int cpu, CpuTime&& cpu_time) {
  const Duration before = cpu_time();
  const std::optional<HttpFigures> figures = run_wrk(port, path, session, seconds, connections, cpu);
  if (!figures) return std::nullopt;
  return Block{figures->requests / flexrf::seconds(cpu_time() - before), figures->p99_us};
}

}  // namespace

bool measure_requests(Report& report, const Machine& machine) {
  Cell cell{{place::panel_load}};
  if (!cell.begin()) return false;
  cell.process().pin("panel", machine.server_cpu);
  std::string body = cell.ask("GET", value).body;
  // Until it has been published.
  for (int tries = 0; tries < 500 && body.find("null") != std::string::npos; ++tries) {
    std::this_thread::sleep_for(10ms);
    body = cell.ask("GET", value).body;
  }
  Nginx nginx{body, machine.server_cpu};
  if (!nginx.begin()) return false;
  const int blocks = report.choose(20, 4);
  const int seconds = report.choose(3, 1);
  Pairs throughput;
  Pairs p99;
  for (int block = -1; block < blocks; ++block) {  // the first, of each, is not counted
    std::optional<Block> sides[2];
    for (const int turn : {0, 1}) {
      const bool is_ours = (turn + block) % 2 == 0;
      sides[is_ours ? 0 : 1] = is_ours
                                   ? run_block(cell.port(), std::string{"/api/v1/"} + value, cell.session(),
                                               seconds, machine.load_cpu, [&] { return cell.server_time(); })
                                   : run_block(nginx.port(), Nginx::path, "", seconds, machine.load_cpu,
                                               [&] { return nginx.cpu_time(); });
    }
    if (!sides[0] || !sides[1]) return false;
    if (block < 0) continue;
    throughput.add(sides[0]->per_cpu_second, sides[1]->per_cpu_second);
    p99.add(sides[0]->p99_us, sides[1]->p99_us);
  }
  const std::string conditions =
      text("%zu B, %d connections, %d blocks of %d s each, CPU %d, load on CPU %d", body.size(), connections,
           blocks, seconds, machine.server_cpu, machine.load_cpu);
  report.add_ratio("GET of a value as JSON against nginx, per CPU second of the server", throughput, 1, "/s",
                   conditions, Goal::at_least);
  report.add_ratio("GET of a value as JSON against nginx, p99", p99, 1.2, "us", conditions);
  return true;
}

}  // namespace flexrf::bench
