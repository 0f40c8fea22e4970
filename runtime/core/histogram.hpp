// A histogram of durations with bounded relative error and a fixed size.
#pragma once

#include <atomic>
#include <bit>
#include <cstdint>

#include "base/time.hpp"

namespace flexrf {

/// Log-linear buckets (as HdrHistogram, G. Tene): 16 per octave, so a quantile is at most 6.25 % too high.
/// add: one thread. Everything else: any thread, and may lag by what is being added.
class Histogram {
 public:
  void add(Duration duration) noexcept {
    const std::uint64_t value = duration.count() < 0 ? 0 : static_cast<std::uint64_t>(duration.count());
    increment(buckets_[bucket_of(value)]);
    increment(count_);
    if (value > maximum_.load(std::memory_order_relaxed)) maximum_.store(value, std::memory_order_relaxed);
  }

  std::uint64_t count() const noexcept { return count_.load(std::memory_order_relaxed); }
  Duration maximum() const noexcept {
    return Duration{static_cast<std::int64_t>(maximum_.load(std::memory_order_relaxed))};
  }
  /// The duration below or at which a share of all lies (0 < share <= 1); zero while empty.
  Duration quantile(double share) const noexcept;

  /// For drawing: 16 buckets per octave up to 2^40 ns (18 minutes); what is longer is in the last.
  static constexpr std::uint32_t buckets = 16 * 38;
  std::uint64_t in_bucket(std::uint32_t bucket) const noexcept {
    return buckets_[bucket].load(std::memory_order_relaxed);
  }
  static Duration upper_bound(std::uint32_t bucket) noexcept;

 private:
  static constexpr std::uint32_t bucket_of(std::uint64_t value) noexcept {
    if (value < 16) return static_cast<std::uint32_t>(value);
    const auto octave = static_cast<std::uint32_t>(std::bit_width(value)) - 5U;
    const std::uint32_t bucket = 16U * octave + static_cast<std::uint32_t>(value >> octave);
    return bucket < buckets ? bucket : buckets - 1;
  }
  // One writer: a load and a store, no read-modify-write.
  template <class Counter>
  static void increment(Counter& counter) noexcept {
    counter.store(counter.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  }

  std::atomic<std::uint64_t> count_{0};
  std::atomic<std::uint64_t> maximum_{0};
  std::atomic<std::uint64_t> buckets_[buckets]{};
};

}  // namespace flexrf
