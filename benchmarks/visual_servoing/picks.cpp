// How well it picks, and how fast its virtual time goes.
#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <thread>

#include "benchmarks/visual_servoing/rows.hpp"
#include "places.hpp"

namespace flexrf::bench {
namespace {

constexpr int first_seed = 101;  // none that it was tuned with
constexpr int first_disturbed_seed = 501;

struct Picks {
  int approaches = 0;
  int good = 0;
  int wrong = 0;
  int contacts = 0;
  int by_the_truth = 0;  // parts that came into no bin although the picker says so
  double minutes = 0;
  std::vector<double> per_minute;
};

/// Results in the order of the seeds; fewer when a run failed.
std::vector<Json> run_seeds(int first, int seeds, int seconds, bool is_disturbed) {
  std::map<int, Json> results;
  std::mutex mutex;
  std::atomic<int> next{0};
  const int cpus = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::vector<std::thread> workers;
  for (int cpu = 0; cpu < std::min(cpus, seeds); ++cpu) {
    workers.emplace_back([&, cpu] {
      for (int i = next++; i < seeds; i = next++) {
        std::vector<std::string> arguments{std::to_string(first + i), std::to_string(seconds)};
        if (is_disturbed) arguments.emplace_back("disturbed");
        const auto result = result_of(place::servoing_picks, arguments, {cpu, 1});
        const std::lock_guard lock{mutex};
        if (result) results[i] = *result;
      }
    });
  }
  for (std::thread& worker : workers) worker.join();
  std::vector<Json> in_order;
  for (auto& [seed, result] : results) in_order.push_back(std::move(result));
  return in_order;
}

void remark_on(Report& report, const Json& seed, const char* list, const char* what) {
  for (const Json& one : seed[list]) {
    report.remark(text("seed %d, %.1f s, %s%s: %s", seed["seed"].get<int>(), one["at"].get<double>(), what,
                       one["part"].get<std::string>().c_str(), one["cause"].get<std::string>().c_str()));
  }
}

Picks add_up(Report& report, const std::vector<Json>& results) {
  Picks sum;
  for (const Json& seed : results) {
    const int lost = std::max(0, seed["binned"].get<int>() - seed["truly_binned"].get<int>());
    const double minutes = seed["judged_seconds"].get<double>() / 60;
    const int good = seed["good"].get<int>() - lost;
    sum.approaches += seed["approaches"].get<int>();
    sum.good += good;
    sum.wrong += static_cast<int>(seed["wrongly_unreachable"].size());
    sum.contacts += seed["contacts"].get<int>();
    sum.by_the_truth += lost;
    sum.minutes += minutes;
    sum.per_minute.push_back(good / minutes);
    remark_on(report, seed, "misses", "missed ");
    remark_on(report, seed, "wrongly_unreachable", "not gone to, though it is free: ");
    if (lost > 0)
      report.remark(text("seed %d: %d in no bin, though the picker says so", seed["seed"].get<int>(), lost));
    for (const Json& contact : seed["first_contacts"]) {
      report.remark(text("seed %d, %.1f s, contact, while: %s", seed["seed"].get<int>(),
                         contact["at"].get<double>(), contact["while"].get<std::string>().c_str()));
    }
  }
  return sum;
}

}  // namespace

bool measure_picks(Report& report) {
  const int seeds = report.choose(20, 2);
  const int seconds = report.choose(120, 12);
  const std::vector<Json> results = run_seeds(first_seed, seeds, seconds, false);
  if (results.empty()) return false;
  const Picks picks = add_up(report, results);
  const int tried = picks.approaches + picks.wrong;
  const Estimate share = wilson(picks.good, tried);
  const std::string conditions =
      text("%zu seeds from %d, %d s each: %d picks, %d approaches, %d wrongly called unreachable",
           results.size(), first_seed, seconds, picks.good, picks.approaches, picks.wrong);
  Row good = plain_row("visual servoing: good picks of all that were begun or wrongly not begun", "%",
                       100 * share.median, conditions);
  good.ours = text("%d of %d", picks.good, tried);
  report.add(with_goal(good, 98, Goal::at_least));
  report.add(with_goal(
      plain_row("visual servoing: lower end of Wilson's 95 % interval of that share", "%", 100 * share.low),
      96, Goal::at_least));
  report.add(with_goal(plain_row("visual servoing: good picks a minute", "", picks.good / picks.minutes,
                                 text("from %.1f to %.1f between the seeds",
                                      *std::min_element(picks.per_minute.begin(), picks.per_minute.end()),
                                      *std::max_element(picks.per_minute.begin(), picks.per_minute.end()))),
                       8, Goal::at_least));
  report.add(
      with_goal(plain_row("visual servoing: contacts of a link, the hand or a held part with an obstacle "
                          "or the table",
                          "", picks.contacts),
                0));
  return static_cast<int>(results.size()) == seeds;
}

bool measure_picks_among_disturbances(Report& report) {
  const int seeds = report.choose(40, 2);
  const int seconds = report.choose(120, 12);
  const std::vector<Json> results = run_seeds(first_disturbed_seed, seeds, seconds, true);
  if (results.empty()) return false;
  const Picks picks = add_up(report, results);
  Row good =
      plain_row("visual servoing, disturbed by a person all the time: good picks of all that were begun", "%",
                100.0 * picks.good / std::max(picks.approaches, 1),
                text("%zu seeds from %d, %d s each; covered lenses, light and pushes end approaches",
                     results.size(), first_disturbed_seed, seconds));
  good.ours = text("%d of %d", picks.good, picks.approaches);
  report.add(with_goal(good, 98, Goal::at_least));
  report.add(with_goal(plain_row("visual servoing, disturbed: contacts of a link, the hand or a held part",
                                 "", picks.contacts),
                       0));
  return static_cast<int>(results.size()) == seeds;
}

bool measure_virtual_time(Report& report) {
  const int seconds = report.choose(20, 5);
  std::vector<double> speeds;
  for (int i = 0; i < report.choose(8, 2); ++i) {
    const auto result =
        result_of(place::servoing_picks, {std::to_string(first_seed + i), std::to_string(seconds)}, {0, 1});
    if (!result) return false;
    speeds.push_back((*result)["run_seconds"].get<double>() / (*result)["wall_seconds"].get<double>());
  }
  Row row = plain_row("visual servoing: virtual time against the wall clock, one core", "x", 0,
                      text("%zu seeds, %d s each, judged by the truth meanwhile", speeds.size(), seconds));
  row.value = estimate(speeds);
  report.add(with_goal(row, 2, Goal::at_least));
  return true;
}

}  // namespace flexrf::bench
