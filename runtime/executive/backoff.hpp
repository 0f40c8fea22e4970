// Back-off: learns the rhythm of one source, so that polling it neither wastes polls nor finds items late.
#pragma once

#include <cstdint>

#include "runtime/core/time.hpp"

namespace flexrf {

/// Bounds of a polling thread's sleeps, as in its trigger.
struct BackoffLimits {
  Duration shortest{};      ///< > 0
  Duration longest{};       ///< >= shortest
  std::uint32_t tries = 4;  ///< misses in a row before the estimate widens, >= 1
};

/// Estimates mean and spread of the time between arrivals, sleeps until just before the next is due, retries
/// in short bounded steps on a miss, and widens the steps after `tries` misses. After Müller, Ziaie, Knoll:
/// "A wait-free realtime system for optimal distribution of vision tasks on multicore architectures", 2008.
/// Pure: time in, time out; one thread, no allocation.
class Backoff {
 public:
  constexpr explicit Backoff(const BackoffLimits& limits) noexcept : limits_(limits) {}

  /// A poll at `now` found items: `count` arrived since the last hit, the latest of them at `arrived` (its
  /// sampled_at, or now where that is not known).
  /// @returns when to poll next, now + shortest to now + longest.
  Time hit(Time now, Time arrived, std::uint64_t count) noexcept;
  /// A poll at `now` found nothing.
  Time miss(Time now) noexcept;

  /// Estimates; zero before the second arrival.
  Duration mean() const noexcept { return Duration{static_cast<std::int64_t>(mean_)}; }
  Duration spread() const noexcept {
    return Duration{static_cast<std::int64_t>(spread_)};
  }  ///< mean deviation

 private:
  Time bounded(Time now, double sleep) const noexcept;

  BackoffLimits limits_;
  double mean_ = 0;    ///< ns
  double spread_ = 0;  ///< ns
  Time arrived_{};     ///< the last arrival; no time before the first
  std::uint32_t misses_ = 0;
  double step_ = 0;  ///< ns, the last retry's
};

}  // namespace flexrf
