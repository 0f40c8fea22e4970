// For how long the application has been healthy without a gap.
#pragma once

#include <string>

#include "base/time.hpp"

namespace flexrf::helper {

/// One thread.
class HealthCount {
 public:
  /// Two looks that are further apart leave a time of which nobody knows.
  static constexpr Duration longest_gap = std::chrono::seconds{15};

  explicit HealthCount(Duration wanted) noexcept : wanted_(wanted) {}

  /// A look: `why_not` is empty where all is well.
  void note(const std::string& why_not, Time now) noexcept {
    const bool goes_on = is_healthy_ && now - looked_at_ <= longest_gap;
    is_healthy_ = why_not.empty();
    if (is_healthy_ && !goes_on) since_ = now;
    looked_at_ = now;
  }
  bool is_enough() const noexcept { return is_healthy_ && looked_at_ - since_ >= wanted_; }
  /// As of the last look.
  Duration so_far() const noexcept { return is_healthy_ ? looked_at_ - since_ : Duration::zero(); }

 private:
  Duration wanted_;
  bool is_healthy_ = false;
  Time since_{};
  Time looked_at_{};
};

}  // namespace flexrf::helper
