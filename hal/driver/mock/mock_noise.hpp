#pragma once

#include <cstdint>

namespace flexrf {

/// Noise that is the same in each run with the same seed (xorshift64; Marsaglia 2003, Xorshift RNGs). The
/// thread the mock lives in.
class MockNoise {
 public:
  void seed(std::uint64_t seed) noexcept { bits_ = seed * 2 + 1; }
  /// At most so much more or less than 0, evenly; nothing is drawn for 0.
  double around_zero(double most) noexcept {
    if (most == 0) return 0;
    return most * (static_cast<double>(draw() >> 11U) / static_cast<double>(1ULL << 52U) - 1);
  }
  /// Likewise, in whole numbers.
  int around_zero(int most) noexcept {
    if (most == 0) return 0;
    return static_cast<int>(draw() % (2 * static_cast<unsigned>(most) + 1)) - most;
  }

 private:
  std::uint64_t draw() noexcept {
    bits_ ^= bits_ << 13U;
    bits_ ^= bits_ >> 7U;
    bits_ ^= bits_ << 17U;
    return bits_;
  }

  std::uint64_t bits_ = 1;
};

}  // namespace flexrf
