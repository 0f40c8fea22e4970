// Missed time: what whoever watches others did not see.
#pragma once

#include <algorithm>
#include <chrono>

#include "base/time.hpp"

namespace flexrf {

/// Where a hypervisor, the firmware or other programs keep the watching thread from running, they may well
/// have kept those that it watches: nobody is blamed for what he did not do in that time. Of each pause
/// between two looks all but `longest_pause` is such time. The watching thread.
class MissedTime {
 public:
  static constexpr Duration longest_pause = std::chrono::milliseconds{100};

  /// Since the last look; nothing at the first.
  Duration until(Time now) noexcept {
    const Duration missed = looked_at_ == Time{} ? Duration{} : now - looked_at_ - longest_pause;
    looked_at_ = now;
    return std::max(missed, Duration{});
  }

 private:
  Time looked_at_{};  // no time: not yet
};

}  // namespace flexrf
