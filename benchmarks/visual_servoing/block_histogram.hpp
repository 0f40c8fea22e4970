// BlockHistogram: durations of one block, whoever measured them: ours and a floor's have the same resolution.
#pragma once

#include <array>
#include <cstdint>

#include "runtime/core/histogram.hpp"

namespace flexrf::bench {

class BlockHistogram {
 public:
  /// What is in it so far.
  explicit BlockHistogram(const Histogram& histogram) noexcept {
    for (std::uint32_t i = 0; i < Histogram::buckets; ++i) counts_[i] = histogram.in_bucket(i);
  }
  /// Without what an earlier one of the same histogram had.
  void subtract(const BlockHistogram& before) noexcept {
    for (std::uint32_t i = 0; i < Histogram::buckets; ++i) counts_[i] -= before.counts_[i];
  }
  std::uint64_t count() const noexcept {
    std::uint64_t sum = 0;
    for (const std::uint64_t count : counts_) sum += count;
    return sum;
  }
  /// In us; within a bucket as if they were spread evenly. 0 for none.
  double quantile(double share) const noexcept {
    const double wanted = share * static_cast<double>(count());
    double before = 0;
    double low = 0;
    for (std::uint32_t i = 0; i < Histogram::buckets; ++i) {
      const auto count = static_cast<double>(counts_[i]);
      const double high = seconds(Histogram::upper_bound(i)) * 1e6;
      if (count > 0 && before + count >= wanted) return low + (high - low) * (wanted - before) / count;
      before += count;
      low = high;
    }
    return low;
  }
  /// Longer than `limit`, and of those in the same bucket as it.
  std::uint64_t above(Duration limit) const noexcept {
    std::uint64_t sum = 0;
    for (std::uint32_t i = 0; i < Histogram::buckets; ++i)
      if (Histogram::upper_bound(i) > limit) sum += counts_[i];
    return sum;
  }

 private:
  std::array<std::uint64_t, Histogram::buckets> counts_{};
};

}  // namespace flexrf::bench
