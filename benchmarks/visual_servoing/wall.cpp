// The cell by the wall clock: processor time, latency, allocations, fewer CPUs, back-off.
#include <random>
#include <thread>

#include "benchmarks/visual_servoing/rows.hpp"
#include "places.hpp"

namespace flexrf::bench {
namespace {

std::optional<Json> run_cell(const char* program, int blocks, int seconds, int cpus = 0) {
  return result_of(program, {std::to_string(blocks), std::to_string(seconds)}, {0, cpus});
}

std::vector<double> of_blocks(const Json& result, const char* figure) {
  std::vector<double> values;
  for (const Json& block : result["blocks"]) values.push_back(block[figure].get<double>());
  return values;
}

/// A quantile of all blocks' values, and `more`; its interval by drawing blocks anew (bootstrap), as values
/// that follow each other are alike.
Estimate quantile_of_all(const Json& result, const char* list, double share, double more = 0) {
  std::vector<std::vector<double>> blocks;
  for (const Json& block : result["blocks"]) {
    blocks.push_back(block[list].get<std::vector<double>>());
    if (blocks.back().empty()) blocks.pop_back();
  }
  if (blocks.empty()) return {};
  const auto of = [&](auto&& which) {
    std::vector<double> values;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      const std::vector<double>& block = blocks[which(i)];
      values.insert(values.end(), block.begin(), block.end());
    }
    return quantile(values, share) + more;
  };
  constexpr int resamplings = 500;
  std::mt19937_64 random{20080511};
  std::uniform_int_distribution<std::size_t> any{0, blocks.size() - 1};
  std::vector<double> drawn;
  for (int i = 0; i < resamplings; ++i) drawn.push_back(of([&](std::size_t) { return any(random); }));
  return {of([](std::size_t i) { return i; }), quantile(drawn, 0.025), quantile(drawn, 0.975)};
}

void add_processor_time(Report& report, const Json& result) {
  const struct {
    const char* part;
    const char* what;
    double goal;  // ms
  } rows[] = {
      {"render", "visual servoing: processor time of a picture, drawing it", 6},
      {"features", "visual servoing: processor time of a picture, shared features", 1.5},
      {"attention", "visual servoing: processor time of a picture, all active members of attention", 2.5},
      {"recognition", "visual servoing: processor time of a picture, recognition and tracks", 2}};
  for (const auto& one : rows) {
    Row row = plain_row(one.what, "ms", 0, "all its threads, as the kernel counts it, waiting and polls too");
    row.value = estimate(of_blocks(result, one.part));
    report.add(with_goal(row, one.goal));
  }
}

void add_latency(Report& report, const Json& result, const std::string& conditions) {
  // The measured age is that at the begin of the control cycle; its end is when the arm has the command.
  const double cycle = result["control_execution_p99_us"].get<double>() * 1e-3;
  const struct {
    const char* name;
    double share;
    double goal;
  } rows[] = {{"p50", 0.5, 33 + 10}, {"p99", 0.99, 33 + 22}};
  for (const auto& one : rows) {
    Row row =
        plain_row(text("visual servoing: from mid-exposure to the first command that used it, %s", one.name),
                  "ms", 0, text("%s; with %.3f ms of the cycle, its p99", conditions.c_str(), cycle));
    row.value = quantile_of_all(result, "latencies_ms", one.share, cycle);
    report.add(with_goal(row, one.goal));
  }
  report.add(plain_row("visual servoing: processor time that the host gave to others meanwhile", "%",
                       100 * result["stolen_share"].get<double>(), "of all CPUs' time"));
}

void add_allocations(Report& report, const Json& result) {
  double sum = 0;
  for (const auto& [thread, count] : result["allocations"].items()) {
    sum += count.get<double>();
    if (count != 0)
      report.remark(text("thread %s allocated or freed %llu times", thread.c_str(),
                         static_cast<unsigned long long>(count.get<std::uint64_t>())));
  }
  report.add(with_goal(plain_row("visual servoing: allocations after the start by any thread with a unit or "
                                 "device",
                                 "", sum),
                       0));
}

bool add_with_fewer_cpus(Report& report, const Json& all, int blocks, int seconds) {
  const int cpus = static_cast<int>(std::thread::hardware_concurrency());
  const auto add = [&](const Json& result, const std::string& which) {
    Row row = plain_row("visual servoing: pictures of 30 in a second that a list of tracks is of, " + which,
                        "/s", 0);
    std::vector<double> rates;
    for (const Json& block : result["blocks"])
      rates.push_back(block["tracked_pictures"].get<double>() / block["seconds"].get<double>());
    row.value = estimate(rates);
    row.note = text("%llu pictures missed, %llu of %llu regions too late, %llu parts in bins",
                    static_cast<unsigned long long>(result["missed_pictures"].get<std::uint64_t>()),
                    static_cast<unsigned long long>(result["outdated_regions"].get<std::uint64_t>()),
                    static_cast<unsigned long long>(result["regions"].get<std::uint64_t>()),
                    static_cast<unsigned long long>(result["binned"].get<std::uint64_t>()));
    report.add(row);
  };
  for (int count = 1; count <= 2 && count < cpus; ++count) {
    const auto result = run_cell(place::servoing_wall, blocks, seconds, count);
    if (!result) return false;
    add(*result, text("%d CPU%s", count, count == 1 ? "" : "s"));
  }
  add(all, text("all %d CPUs", cpus));
  return true;
}

void add_backoff_rows(Report& report, const Json& result, const char* way) {
  const auto polls = result["polls"].get<double>();
  const auto found = result["polls_that_found"].get<double>();
  const auto regions = result["regions"].get<double>();
  report.add(plain_row(text("visual servoing: recognition's empty polls for each region, %s", way), "",
                       regions > 0 ? (polls - found) / regions : 0,
                       text("%.0f polls, %.0f with a verdict, %.0f regions", polls, found, regions)));
  for (const auto& [name, share] : {std::pair{"p50", 0.5}, std::pair{"p99", 0.99}}) {
    Row row = plain_row(
        text("visual servoing: a picture's first region waits for a recogniser, %s, %s", way, name), "us", 0);
    row.value = quantile_of_all(result, "first_looks_us", share);
    report.add(row);
  }
}

}  // namespace

bool measure_by_the_wall(Report& report) {
  const int blocks = report.choose(30, 2);
  const int seconds = report.choose(10, 3);
  const auto all = run_cell(place::servoing_wall, blocks, seconds);
  if (!all) return false;
  std::string conditions = text("%d blocks of %d s", blocks, seconds);
  if (!(*all)["realtime"].get<bool>()) conditions += ", without real-time rights";
  add_processor_time(report, *all);
  add_latency(report, *all, conditions);
  add_allocations(report, *all);
  const int fewer = report.choose(6, 1);
  if (!add_with_fewer_cpus(report, *all, fewer, seconds)) return false;
  add_backoff_rows(report, *all, "back-off");
  const std::pair<const char*, const char*> others[] = {{place::servoing_wall_doorbell, "doorbell"},
                                                        {place::servoing_wall_polling, "polled each ms"}};
  for (const auto& [program, way] : others) {
    const auto result = run_cell(program, fewer, seconds);
    if (!result) return false;
    add_backoff_rows(report, *result, way);
  }
  return true;
}

}  // namespace flexrf::bench
