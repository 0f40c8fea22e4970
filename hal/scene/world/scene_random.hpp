// SceneRandom: numbers that look random and are the same on every machine.
#pragma once

#include <cstdint>

namespace flexrf {

/// SplitMix64 (Steele, Lea, Flood 2014, Fast splittable pseudorandom number generators), and nothing of the
/// standard library's distributions, whose results each library makes in its own way. One thread.
class SceneRandom {
 public:
  void seed(std::uint64_t seed) noexcept { state_ = seed; }

  std::uint64_t bits() noexcept {
    std::uint64_t mixed = (state_ += 0x9E3779B97F4A7C15U);
    mixed = (mixed ^ (mixed >> 30U)) * 0xBF58476D1CE4E5B9U;
    mixed = (mixed ^ (mixed >> 27U)) * 0x94D049BB133111EBU;
    return mixed ^ (mixed >> 31U);
  }
  /// From `low` to below `high`, evenly.
  double between(double low, double high) noexcept {
    return low + (high - low) * (static_cast<double>(bits() >> 11U) * 0x1p-53);
  }
  /// From 0 to below `count`; the smallest numbers come more often by less than 1 in 2^40.
  std::uint32_t below(std::uint32_t count) noexcept {
    return static_cast<std::uint32_t>((bits() >> 8U) % count);
  }

 private:
  std::uint64_t state_ = 0;
};

}  // namespace flexrf
