// The control thread beside vision at full load, against cyclictest and a bare loop.
#include "benchmarks/visual_servoing/rows.hpp"
#include "places.hpp"

namespace flexrf::bench {
namespace {

struct Sums {
  double over_budget = 0;
  double switches = 0;
  double cycles = 0;

  void add(const Json& block) {
    over_budget += block["over_budget"].get<double>();
    switches += block["switches"].get<double>();
    cycles += block["cycles"].get<double>();
  }
};

}  // namespace

bool measure_control_thread(Report& report) {
  const int blocks = report.choose(60, 2);
  const int seconds = report.choose(10, 2);
  const auto result = result_of(place::servoing_control, {std::to_string(blocks), std::to_string(seconds)});
  if (!result) return false;
  if (!result->contains("blocks")) {
    report.remark("the control thread was not judged: that needs real-time rights and two CPUs");
    return true;
  }
  Pairs p50;
  Pairs p99;
  Sums all;
  Sums ours;  // beside the bare loop
  Sums bare;
  for (const Json& pair : (*result)["blocks"]) {
    const Json& block = pair["ours"];
    all.add(block);
    if (pair.contains("cyclictest")) {
      const Json& floor = pair["cyclictest"];
      p50.add(block["p50_us"].get<double>(), floor["p50_us"].get<double>());
      p99.add(block["p99_us"].get<double>(), floor["p99_us"].get<double>());
    } else if (pair.contains("bare_loop")) {
      ours.add(block);
      bare.add(pair["bare_loop"]);
    }
  }
  const Json& conditions = (*result)["conditions"];
  const std::string how =
      text("%d blocks of %d s, every other beside cyclictest; 7 ms, priority %d, CPU %d", blocks, seconds,
           conditions["priority"].get<int>(), conditions["cpu"].get<int>());
  if (p50.ratio().median > 0) {
    report.add_ratio("visual servoing: control thread's lateness against cyclictest, p50", p50, 1.05, "us",
                     how);
    report.add_ratio("visual servoing: control thread's lateness against cyclictest, p99", p99, 1.2, "us",
                     how);
  } else {
    report.remark("cyclictest gave no measurement: are rt-tests installed?");
  }
  Row over =
      plain_row("visual servoing: control cycles over their budget, beyond those of a bare loop", "",
                ours.over_budget - bare.over_budget,
                text("budget %.0f us, bare loop %.0f us; %.0f and %.0f cycles, in all %.0f over of %.0f",
                     conditions["budget_us"].get<double>(), conditions["bare_loop_us"].get<double>(),
                     ours.cycles, bare.cycles, all.over_budget, all.cycles));
  over.ours = text("%.0f", ours.over_budget);
  over.floor = text("%.0f", bare.over_budget);
  report.add(with_goal(over, 0));
  // Whoever may not run on its CPU cannot keep it from there.
  const bool shared = (*result)["sharers"].get<int>() > 0;
  report.add(
      with_goal(plain_row("visual servoing: control cycles that another of our threads delayed", "",
                          shared ? all.switches : 0,
                          text("%d of our threads may run on its CPU; it was interrupted %.0f times for "
                               "another thread, the bare loop %.0f times in half as long",
                               (*result)["sharers"].get<int>(), all.switches, bare.switches)),
                0));
  return true;
}

}  // namespace flexrf::bench
