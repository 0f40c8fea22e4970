// How often something may happen.
#pragma once

#include <algorithm>
#include <cstdint>

#include "base/time.hpp"

namespace flexrf::panel {

/// A bucket of one second's tokens, filled at `rate` per second.
class RateLimit {
 public:
  explicit RateLimit(std::uint32_t rate) noexcept
      : gap_(Duration{std::chrono::seconds{1}} / std::max(rate, 1U)) {}

  void reset() noexcept { spent_until_ = Time{}; }
  /// False: too often. Time may stand still between calls.
  bool take(Time now) noexcept {
    if (spent_until_ > now + std::chrono::seconds{1}) return false;
    spent_until_ = std::max(spent_until_, now) + gap_;
    return true;
  }

 private:
  Duration gap_;
  Time spent_until_{};
};

}  // namespace flexrf::panel
