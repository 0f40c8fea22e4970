// Back-off against fixed-interval polling: added latency (p50) at equal empty polls, for a periodic, a
// jittering and a bursty producer. The estimator is judged in simulated time, where each block of 10 s polls
// the same arrivals twice; a shorter run against the wall clock shows what the machine's own timers add to
// both.

#include "runtime/executive/backoff.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <random>
#include <thread>
#include <vector>

namespace flexrf {
namespace {

using namespace std::chrono_literals;

constexpr BackoffLimits limits{100us, 50ms, 4};
constexpr Duration learning = 2s;  ///< before each measurement, not counted
constexpr Duration block_length = 10s;
constexpr int blocks = 20;
constexpr Duration wall_length = 3s;

enum class Producer { periodic, jittering, bursty };
constexpr struct {
  Producer producer;
  const char* name;
} producers[] = {{Producer::periodic, "periodic, 10 ms"},
                 {Producer::jittering, "jittering, 10 ms, sigma 1 ms"},
                 {Producer::bursty, "bursty, 5 in 8 ms, then 92 ms, sigma 3 ms"}};

std::vector<Time> arrivals_of(Producer producer, Duration length, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<Time> arrivals;
  double at = 0;
  for (int i = 0; at < seconds(length); ++i) {
    double gap = 0.010;
    if (producer == Producer::jittering) gap = std::max(0.001, 0.010 + 0.001 * normal(random));
    if (producer == Producer::bursty)
      gap = i % 5 == 0 ? 0.092 + 0.003 * normal(random) : 0.002 + 0.0001 * normal(random);
    at += gap;
    arrivals.push_back(Time{Duration{static_cast<std::int64_t>((1 + at) * 1e9)}});
  }
  return arrivals;
}

struct Figures {
  double empty_polls;  ///< per item
  double median;       ///< latency, ns
};

/// Collects what polls found.
class Tally {
 public:
  explicit Tally(Time from) : from_(from) {}
  void polled(Time now, const Time* first, const Time* last) {
    if (now < from_) return;
    if (first == last) ++empty_polls_;
    for (; first != last; ++first) latencies_.push_back(static_cast<double>((now - *first).count()));
  }
  Figures figures() {
    const auto middle = latencies_.begin() + static_cast<std::ptrdiff_t>(latencies_.size() / 2);
    std::nth_element(latencies_.begin(), middle, latencies_.end());
    return {static_cast<double>(empty_polls_) / static_cast<double>(latencies_.size()), *middle};
  }

 private:
  Time from_;
  std::uint64_t empty_polls_ = 0;
  std::vector<double> latencies_;
};

/// `next(now, found, arrived)` says when to poll again.
template <class Next>
Figures poll_simulated(const std::vector<Time>& arrivals, Next next) {
  Tally tally(arrivals.front() + learning);
  const Time* taken = arrivals.data();
  const Time* const end = arrivals.data() + arrivals.size();
  for (Time now = arrivals.front(); taken != end;) {
    const Time* const visible = std::upper_bound(taken, end, now);
    tally.polled(now, taken, visible);
    const auto found = static_cast<std::uint64_t>(visible - taken);
    now = next(now, found, found > 0 ? visible[-1] : now);
    taken = visible;
  }
  return tally.figures();
}

void sleep_until(Time time) {
  const timespec at{static_cast<time_t>(nanoseconds(time) / 1'000'000'000),
                    nanoseconds(time) % 1'000'000'000};
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &at, nullptr);
}

/// A thread produces, this one polls; times are the clock's.
template <class Next>
Figures poll_wall(const std::vector<Time>& schedule, Next next) {
  std::vector<Time> arrivals(schedule.size());
  std::atomic<std::size_t> visible{0};
  const Duration shift = MonotonicClock::now() - schedule.front() + 10ms;
  std::thread producer([&] {
    for (std::size_t i = 0; i < schedule.size(); ++i) {
      sleep_until(schedule[i] + shift);
      arrivals[i] = MonotonicClock::now();
      visible.store(i + 1, std::memory_order_release);
    }
  });
  Tally tally(schedule.front() + shift + learning / 2);
  std::size_t taken = 0;
  while (taken < schedule.size()) {
    const std::size_t now_visible = visible.load(std::memory_order_acquire);
    const Time now = MonotonicClock::now();
    tally.polled(now, arrivals.data() + taken, arrivals.data() + now_visible);
    const Time wake = next(now, now_visible - taken, now_visible > taken ? arrivals[now_visible - 1] : now);
    taken = now_visible;
    sleep_until(wake);
  }
  producer.join();
  return tally.figures();
}

auto by_backoff(Backoff& backoff, bool knows_arrival) {
  return [&backoff, knows_arrival](Time now, std::uint64_t found, Time arrived) {
    return found > 0 ? backoff.hit(now, knows_arrival ? arrived : now, found) : backoff.miss(now);
  };
}

auto by_interval(Duration interval) {
  return [interval](Time now, std::uint64_t, Time) { return now + interval; };
}

/// The interval at which fixed polling has as many empty polls per item.
Duration interval_at_equal_cost(const std::vector<Time>& arrivals, double empty_polls) {
  double shortest = 1e4;
  double longest = 1e9;
  for (int i = 0; i < 24; ++i) {
    const double interval = std::sqrt(shortest * longest);
    const Figures figures =
        poll_simulated(arrivals, by_interval(Duration{static_cast<std::int64_t>(interval)}));
    (figures.empty_polls > empty_polls ? shortest : longest) = interval;
  }
  return Duration{static_cast<std::int64_t>(longest)};
}

double median_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

/// 95 % interval of the median, by resampling.
std::pair<double, double> interval_of_median(const std::vector<double>& values) {
  std::mt19937_64 random(1);
  std::uniform_int_distribution<std::size_t> any(0, values.size() - 1);
  std::vector<double> medians;
  for (int i = 0; i < 2000; ++i) {
    std::vector<double> sample;
    for (std::size_t k = 0; k < values.size(); ++k) sample.push_back(values[any(random)]);
    medians.push_back(median_of(std::move(sample)));
  }
  std::sort(medians.begin(), medians.end());
  return {medians[50], medians[1949]};
}

void measure_simulated(Producer producer, const char* name, bool knows_arrival) {
  std::vector<double> ratios;
  Figures ours{};
  Figures fixed{};
  for (int block = 0; block < blocks; ++block) {
    const auto arrivals =
        arrivals_of(producer, learning + block_length, static_cast<std::uint64_t>(block) + 1);
    Backoff backoff(limits);
    ours = poll_simulated(arrivals, by_backoff(backoff, knows_arrival));
    fixed = poll_simulated(arrivals, by_interval(interval_at_equal_cost(arrivals, ours.empty_polls)));
    ratios.push_back(ours.median / fixed.median);
  }
  const auto [low, high] = interval_of_median(ratios);
  std::printf("  %-43s %-14s %6.3f  [%.3f, %.3f]   %8.1f us %8.1f us   %.2f\n", name,
              knows_arrival ? "known" : "not known", median_of(ratios), low, high, ours.median / 1e3,
              fixed.median / 1e3, ours.empty_polls);
}

void measure_wall(Producer producer, const char* name) {
  const auto schedule = arrivals_of(producer, learning / 2 + wall_length, 1);
  Backoff backoff(limits);
  const Figures ours = poll_wall(schedule, by_backoff(backoff, true));
  const Figures fixed = poll_wall(schedule, by_interval(interval_at_equal_cost(schedule, ours.empty_polls)));
  std::printf("  %-43s %6.3f   %8.1f us %8.1f us   %.2f %.2f\n", name, ours.median / fixed.median,
              ours.median / 1e3, fixed.median / 1e3, ours.empty_polls, fixed.empty_polls);
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  std::printf("backoff: added latency p50 over fixed-interval polling with as many empty polls; goal 0.5\n");
  std::printf(
      "simulated time, %d blocks of 10 s, median of ratios with 95 %% interval; times of the last block\n",
      blocks);
  std::printf("  %-43s %-14s %6s  %-16s %11s %11s   %s\n", "producer", "arrival", "ratio", "", "back-off",
              "fixed", "empty polls per item");
  for (const auto& [producer, name] : producers) measure_simulated(producer, name, true);
  for (const auto& [producer, name] : producers) measure_simulated(producer, name, false);
  std::printf("wall clock, threads that are not real-time, one run of 3 s each\n");
  std::printf("  %-43s %6s   %11s %11s   %s\n", "producer", "ratio", "back-off", "fixed",
              "empty polls per item, of each");
  for (const auto& [producer, name] : producers) measure_wall(producer, name);
  return 0;
}
