#include "runtime/core/histogram.hpp"

#include <cmath>

namespace flexrf {

Duration Histogram::upper_bound(std::uint32_t bucket) noexcept {
  if (bucket < 16) return Duration{bucket};
  // Bucket 16 * octave + m, m in [16, 32): values m << octave up to ((m + 1) << octave) - 1.
  const std::uint32_t octave = bucket / 16 - 1;
  const std::uint64_t mantissa = bucket - 16U * octave;
  return Duration{static_cast<std::int64_t>(((mantissa + 1) << octave) - 1)};
}

Duration Histogram::quantile(double share) const noexcept {
  const std::uint64_t total = count();
  if (total == 0) return {};
  const auto wanted = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(total)));
  std::uint64_t seen = 0;
  for (std::uint32_t bucket = 0; bucket < buckets; ++bucket) {
    seen += in_bucket(bucket);
    if (seen >= wanted && seen > 0) {
      const Duration bound = upper_bound(bucket);
      return bound < maximum() ? bound : maximum();
    }
  }
  return maximum();
}

}  // namespace flexrf
