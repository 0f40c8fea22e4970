// How soon whoever changes a parameter has the answer: it goes to the component's thread and back.
#include <cstdio>

#include "benchmarks/panel/cell.hpp"
#include "benchmarks/panel/live_client.hpp"
#include "benchmarks/panel/rows.hpp"
#include "places.hpp"

namespace flexrf::bench {
namespace {

/// Median of the time from a message to its answer over so many, us; less than 0: one had none.
double answer_time(LiveClient& link, int count, std::string_view op, std::string_view fields) {
  std::vector<double> all;
  for (int i = 0; i < count; ++i) {
    const Time sent = MonotonicClock::now();
    const std::string answer = link.answer_to(link.send(op, fields));
    if (answer.find(R"("ok":true)") == std::string::npos) {
      std::fprintf(stderr, "panel: %.*s: %s\n", static_cast<int>(op.size()), op.data(), answer.c_str());
      return -1;
    }
    all.push_back(static_cast<double>((MonotonicClock::now() - sent).count()) * 1e-3);
  }
  return quantile(all, 0.5);
}

}  // namespace

bool measure_changes(Report& report, const Machine& machine) {
  Cell cell{{place::panel_load}};
  if (!cell.begin()) return false;
  cell.process().pin("panel", machine.server_cpu);
  LiveClient link;
  if (!link.connect(cell.port(), cell.session())) return false;
  constexpr int each = 100;
  Pairs pairs;
  for (int block = 0; block < report.choose(20, 4); ++block) {
    // Half of all wait for the step of the component's thread, whose period is 1 ms.
    const double ours = answer_time(link, each, "set", R"("component":"mover","values":{"run":false})");
    const double floor = answer_time(link, each, "ping", "\"sent\":0");
    if (ours < 0 || floor < 0) return false;
    pairs.add(ours, floor);
  }
  const Estimate ours = pairs.ours();
  const Estimate floor = pairs.floor();
  report.add(
      {"answer to a change of a parameter, from message to message, p50", "us", ours, 0, false,
       text("to a ping %.0f us; %d changes and pings by turns; the component's thread rings, nobody polls",
            floor.median, report.choose(20, 4) * each)});
  return true;
}

}  // namespace flexrf::bench
