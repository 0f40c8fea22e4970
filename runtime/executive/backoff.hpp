// Back-off: learns the rhythm of one source, so that polling it neither wastes polls nor finds items late.
#pragma once

#include <cstdint>

#include "base/time.hpp"

namespace flexrf {

/// Bounds of a polling thread's sleeps, as in its trigger.
struct BackoffLimits {
  Duration shortest{};      ///< > 0
  Duration longest{};       ///< >= shortest
  std::uint32_t tries = 4;  ///< retries across the time when an item is due, >= 1; then the steps widen
};

/// Estimates mean and spread of the time between arrivals, sleeps until just before the next is due, and on a
/// miss retries in short steps: `tries` of them cross the time in which it is likely to come, further ones
/// double up to the longest. A source that comes in bursts has two rhythms, within and between bursts: while
/// a burst may go on one poll looks for its next item. After Müller, Ziaie, Knoll: "A wait-free realtime
/// system for optimal distribution of vision tasks on multicore architectures", 2008. Pure: time in, time
/// out; one thread, no allocation.
class Backoff {
 public:
  constexpr explicit Backoff(const BackoffLimits& limits) noexcept : limits_(limits) {}

  /// A poll at `now` found items: `count` (>= 1) came since the last hit, the latest of them at `arrived`:
  /// its sampled_at, or `now` where that is not known.
  /// @returns when to poll next: now + shortest to now + longest.
  Time hit(Time now, Time arrived, std::uint64_t count) noexcept;
  /// A poll at `now` found nothing.
  Time miss(Time now) noexcept;

  /// Estimates of the time between arrivals, of bursts where there are such; zero before the second arrival.
  Duration mean() const noexcept { return Duration{static_cast<std::int64_t>(rhythm_.mean)}; }
  /// Mean absolute deviation.
  Duration spread() const noexcept { return Duration{static_cast<std::int64_t>(rhythm_.spread)}; }

 private:
  /// Times between arrivals, ns. A mean of zero: not known.
  struct Rhythm {
    double mean = 0;
    double spread = 0;
    void start(double interval) noexcept;
    void add(double interval) noexcept;
  };

  void learn(double interval, double count) noexcept;
  Time expect(Time now, bool in_burst) noexcept;
  double margin(const Rhythm& rhythm) const noexcept;
  Time bounded(Time now, Time wanted) const noexcept;

  BackoffLimits limits_;
  Rhythm rhythm_;           ///< the only one, or that between bursts
  Rhythm burst_;            ///< within bursts
  double burst_share_ = 0;  ///< of intervals that are within bursts, lately
  Time arrived_{};          ///< of the latest item; no time before the first
  Time visible_{};          ///< when it could be polled, as far as known
  Time due_{};              ///< when the next is expected to be
  Time last_miss_{};
  Time hit_at_{};
  double delay_ = 0;  ///< ns from arrival to visibility, as learned
  Duration step_{};   ///< between retries
  std::uint32_t misses_ = 0;
  std::uint32_t batches_ = 0;  ///< hits with several items
  bool in_burst_ = false;      ///< due_ is of the next item in a burst
};

}  // namespace flexrf
