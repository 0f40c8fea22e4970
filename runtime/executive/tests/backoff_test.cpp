#include "runtime/executive/backoff.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <span>

#include "tests/cmocka.hpp"

namespace flexrf::backoff_test {
namespace {

using namespace std::chrono_literals;

constexpr BackoffLimits limits{100us, 50ms, 4};
constexpr int items = 4000;

// Static: a failing assertion jumps over destructors.
Time arrival_times[items];
double latencies[items];

using Arrivals = std::span<const Time>;

struct Figures {
  double empty_polls;  ///< per item
  double median;       ///< latency, ns
  double worst;        ///< latency, ns
};

/// Polls a source whose items arrive at given times, in simulated time; the first quarter is for learning.
/// `next(now, found, arrived)` says when to poll again.
template <class Next>
Figures poll(Arrivals arrivals, Next next) {
  std::size_t measured = 0;
  std::size_t taken = 0;
  double empty_polls = 0;
  Time now = arrivals.front();
  while (taken < arrivals.size()) {
    std::size_t visible = taken;
    while (visible < arrivals.size() && arrivals[visible] <= now) ++visible;
    if (taken >= arrivals.size() / 4) {
      if (visible == taken) ++empty_polls;
      for (std::size_t i = taken; i < visible; ++i)
        latencies[measured++] = static_cast<double>((now - arrivals[i]).count());
    }
    const Time arrived = visible > taken ? arrivals[visible - 1] : now;
    const Time then = next(now, visible - taken, arrived);
    assert_true(then > now);
    now = then;
    taken = visible;
  }
  std::sort(latencies, latencies + measured);
  return {empty_polls / static_cast<double>(measured), latencies[measured / 2], latencies[measured - 1]};
}

Figures poll_with_backoff(Arrivals arrivals, Backoff& backoff, bool knows_arrival = true) {
  return poll(arrivals, [&](Time now, std::size_t found, Time arrived) {
    const Time then = found > 0 ? backoff.hit(now, knows_arrival ? arrived : now, found) : backoff.miss(now);
    assert_true(then - now >= limits.shortest && then - now <= limits.longest);
    return then;
  });
}

/// Fixed-interval polling with as many empty polls per item.
Figures poll_at_equal_cost(Arrivals arrivals, double empty_polls) {
  double shortest = 1e4;
  double longest = 1e9;
  Figures figures{};
  for (int i = 0; i < 24; ++i) {
    const double interval = std::sqrt(shortest * longest);
    figures = poll(arrivals, [interval](Time now, std::size_t, Time) {
      return now + Duration{static_cast<std::int64_t>(interval)};
    });
    (figures.empty_polls > empty_polls ? shortest : longest) = interval;
  }
  return figures;
}

/// Arrivals, the gap before each as `gap(i)` in seconds.
template <class Gap>
Arrivals arrivals_with(Gap gap) {
  double at = 1;
  for (int i = 0; i < items; ++i) {
    at += gap(i);
    arrival_times[i] = Time{Duration{static_cast<std::int64_t>(at * 1e9)}};
  }
  return arrival_times;
}

void check_against_fixed(Arrivals arrivals) {
  for (const bool knows_arrival : {true, false}) {
    Backoff backoff(limits);
    const Figures ours = poll_with_backoff(arrivals, backoff, knows_arrival);
    const Figures fixed = poll_at_equal_cost(arrivals, ours.empty_polls);
    assert_true(ours.median <= 0.5 * fixed.median);
  }
}

// [exec-12]
void periodic_source(void**) {
  const Arrivals arrivals = arrivals_with([](int) { return 0.010; });
  for (const bool knows_arrival : {true, false}) {
    Backoff backoff(limits);
    const Figures figures = poll_with_backoff(arrivals, backoff, knows_arrival);
    assert_true(std::abs((backoff.mean() - 10ms).count()) < 100'000);
    assert_true(backoff.spread() < 200us);
    assert_true(figures.empty_polls <= 2);
    assert_true(figures.worst <= 200e3);
  }
  check_against_fixed(arrivals);
}

void jittering_source(void**) {
  std::minstd_rand random(1);
  std::normal_distribution<double> jitter(0.010, 0.001);
  const Arrivals arrivals = arrivals_with([&](int) { return jitter(random); });
  Backoff backoff(limits);
  const Figures figures = poll_with_backoff(arrivals, backoff);
  assert_true(std::abs((backoff.mean() - 10ms).count()) < 1'000'000);
  assert_true(backoff.spread() > 300us && backoff.spread() < 2ms);
  assert_true(figures.empty_polls <= 4);
  check_against_fixed(arrivals);
}

void bursty_source(void**) {
  const Arrivals regular = arrivals_with([](int i) { return i % 5 == 0 ? 0.092 : 0.002; });
  Backoff backoff(limits);
  const Figures figures = poll_with_backoff(regular, backoff);
  assert_true(std::abs((backoff.mean() - 92ms).count()) < 1'000'000);
  assert_true(figures.median <= 100e3);
  check_against_fixed(regular);
  std::minstd_rand random(1);
  std::normal_distribution<double> within(0.002, 0.0001);
  std::normal_distribution<double> pause(0.092, 0.003);
  check_against_fixed(arrivals_with([&](int i) { return i % 5 == 0 ? pause(random) : within(random); }));
  check_against_fixed(arrivals_with([](int i) { return i % 4 == 0 ? 0.040 : 0.0; }));
}

// [exec-12]
void follows_a_change_of_pace(void**) {
  const Arrivals arrivals = arrivals_with([](int i) { return i < items / 2 ? 0.010 : 0.025; });
  Backoff backoff(limits);
  poll_with_backoff(arrivals, backoff);
  assert_true(std::abs((backoff.mean() - 25ms).count()) < 500'000);
}

void lost_items_do_not_unlearn(void**) {
  const Arrivals arrivals = arrivals_with([](int i) { return i % 20 == 0 ? 0.020 : 0.010; });
  Backoff backoff(limits);
  const Figures figures = poll_with_backoff(arrivals, backoff);
  assert_true(figures.median <= 200e3);
}

void retries_and_then_widens(void**) {
  Backoff backoff(limits);
  Time now{1s};
  for (int i = 0; i < 100; ++i) {
    backoff.hit(now + 1us, now, 1);
    now += 10ms;
  }
  Time poll_at = backoff.hit(now + 1us, now, 1);
  const Time due = now + 10ms;
  assert_true(poll_at <= due && poll_at > due - 1ms);
  // Nothing comes: `tries` even steps, then each twice the last, then the longest.
  Duration steps[20];
  for (Duration& step : steps) {
    const Time next = backoff.miss(poll_at);
    step = next - poll_at;
    poll_at = next;
  }
  for (std::size_t i = 1; i < limits.tries; ++i) assert_true(steps[i] == steps[0]);
  assert_true(steps[0] < 1ms);
  for (std::size_t i = limits.tries; i < 8; ++i) assert_true(steps[i] == 2 * steps[i - 1]);
  assert_true(steps[19] == limits.longest);
}

void sleeps_no_longer_than_the_longest(void**) {
  const Arrivals arrivals = arrivals_with([](int) { return 0.200; });
  Backoff backoff(limits);
  const Figures figures = poll_with_backoff(arrivals, backoff);  // checks each sleep
  assert_true(figures.worst <= 1e6);
  assert_true(figures.empty_polls >= 3);
}

void silent_source_is_polled_ever_less(void**) {
  Backoff backoff(limits);
  Time now{1s};
  Duration last{};
  for (int i = 0; i < 30; ++i) {
    const Time next = backoff.miss(now);
    assert_true(next - now >= last);
    last = next - now;
    now = next;
  }
  assert_true(last == limits.longest);
}

}  // namespace
}  // namespace flexrf::backoff_test

int main() {
  using namespace flexrf::backoff_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(periodic_source),
      cmocka_unit_test(jittering_source),
      cmocka_unit_test(bursty_source),
      cmocka_unit_test(follows_a_change_of_pace),
      cmocka_unit_test(lost_items_do_not_unlearn),
      cmocka_unit_test(retries_and_then_widens),
      cmocka_unit_test(sleeps_no_longer_than_the_longest),
      cmocka_unit_test(silent_source_is_polled_ever_less),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
