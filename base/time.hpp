// Time as the whole runtime counts it: CLOCK_MONOTONIC in nanoseconds.
#pragma once

#include <chrono>
#include <cstdint>
#include <ctime>

namespace flexrf {

using Duration = std::chrono::nanoseconds;

/// CLOCK_MONOTONIC as a std::chrono clock. The default-constructed time point (0) means "no time".
struct MonotonicClock {
  using duration = Duration;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<MonotonicClock>;
  static constexpr bool is_steady = true;

  /// Costs about 16 ns; publishing and reading never call it.
  static time_point now() noexcept {
    timespec value{};
    clock_gettime(CLOCK_MONOTONIC, &value);
    return time_point{Duration{static_cast<std::int64_t>(value.tv_sec) * 1'000'000'000 + value.tv_nsec}};
  }
};

/// An instant on CLOCK_MONOTONIC, or on the simulated clock in virtual time.
using Time = MonotonicClock::time_point;

constexpr std::int64_t nanoseconds(Time time) noexcept {
  return time.time_since_epoch().count();
}
constexpr double seconds(Duration duration) noexcept {
  return static_cast<double>(duration.count()) * 1e-9;
}
/// Of so many seconds, to the nearest nanosecond; the most or the least that there is where it does not fit,
/// 0 of what is not a number.
constexpr Duration duration_of(double seconds) noexcept {
  constexpr double fits = 9.2e9;  // 292 years
  if (seconds != seconds) return Duration{};
  if (seconds >= fits) return Duration::max();
  if (seconds <= -fits) return Duration::min();
  return Duration{static_cast<Duration::rep>(seconds * 1e9 + (seconds < 0 ? -0.5 : 0.5))};
}

}  // namespace flexrf
