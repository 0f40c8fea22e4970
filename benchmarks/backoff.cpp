// Back-off against fixed-interval polling: added latency (p50) at equal empty polls, for a periodic, a
// jittering and a bursty producer. The estimator is judged in simulated time, where each block of 10 s polls
// the same arrivals twice; a shorter run against the wall clock shows what the machine's own timers add to
// both.

#include "runtime/executive/backoff.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <random>
#include <thread>
#include <vector>

#include "benchmarks/harness.hpp"

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

void measure_simulated(bench::Report& report, Producer producer, const char* name, bool knows_arrival) {
  bench::Pairs pairs;
  double empty_polls = 0;
  const int count = report.choose(blocks, 4);
  for (int block = 0; block < count; ++block) {
    const auto arrivals =
        arrivals_of(producer, learning + block_length, static_cast<std::uint64_t>(block) + 1);
    Backoff backoff(limits);
    const Figures ours = poll_simulated(arrivals, by_backoff(backoff, knows_arrival));
    const Figures fixed =
        poll_simulated(arrivals, by_interval(interval_at_equal_cost(arrivals, ours.empty_polls)));
    pairs.add(ours.median, fixed.median);
    empty_polls += ours.empty_polls / count;
  }
  report.add_ratio(bench::text("back-off, %s, arrival %s", name, knows_arrival ? "known" : "not known"),
                   pairs, 0.5, "ns", bench::text("simulated time, %.2f empty polls per item", empty_polls));
}

void measure_wall(bench::Report& report, Producer producer, const char* name) {
  const auto schedule = arrivals_of(producer, learning / 2 + report.choose(wall_length, Duration{2s}), 1);
  Backoff backoff(limits);
  const Figures ours = poll_wall(schedule, by_backoff(backoff, true));
  const Figures fixed = poll_wall(schedule, by_interval(interval_at_equal_cost(schedule, ours.empty_polls)));
  bench::Pairs pairs;
  pairs.add(ours.median, fixed.median);
  report.add_ratio(bench::text("back-off, %s, wall clock", name), pairs, 0.5, "ns",
                   bench::text("one run, not real-time; %.2f against %.2f empty polls per item",
                               ours.empty_polls, fixed.empty_polls));
}

}  // namespace
}  // namespace flexrf

int main(int argument_count, char** arguments) {
  using namespace flexrf;
  bench::Report report("backoff", argument_count, arguments);
  for (const auto& [producer, name] : producers) {
    measure_simulated(report, producer, name, true);
    measure_simulated(report, producer, name, false);
    measure_wall(report, producer, name);
  }
  return report.finish();
}
