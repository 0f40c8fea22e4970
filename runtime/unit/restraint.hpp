// Restraint: why a component does less than it was commanded.
#pragma once

#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>

#include "base/time.hpp"

namespace flexrf {

/// What was asked for and what is done instead, as "position above `highest`", 1200, 1000. Without numbers
/// both are not a number.
struct Restraint {
  const char* reason = nullptr;  ///< lives for ever; null: none
  double asked = std::numeric_limits<double>::quiet_NaN();
  double given = std::numeric_limits<double>::quiet_NaN();
};

/// Its words, the same for everybody who tells of it: "position above `highest`: 1200 was asked for, 1000 is
/// done"; "": there is none. Allocates nothing, so that a real-time thread may say it.
struct RestraintText {
  explicit RestraintText(const Restraint& restraint) noexcept {
    if (restraint.reason == nullptr) return;
    if (std::isnan(restraint.asked)) {
      std::snprintf(text, sizeof(text), "%.140s", restraint.reason);
    } else {
      std::snprintf(text, sizeof(text), "%.140s: %.6g was asked for, %.6g is done", restraint.reason,
                    restraint.asked, restraint.given);
    }
  }

  char text[200] = "";
};

/// What everybody may see of it, and how often there was one. Written by the component's thread; all-zero:
/// none.
class SharedRestraint {
 public:
  /// After each step or send, with what the component said in it. True: it is another one than before, which
  /// is to be logged. One that comes and goes from cycle to cycle is one.
  bool note(const Restraint& restraint, Time now) noexcept {
    if (restraint.reason == nullptr) {
      if (reason_.load(std::memory_order_relaxed) != nullptr && now - noted_at_ > lasts)
        reason_.store(nullptr, std::memory_order_release);
      return false;
    }
    noted_at_ = now;
    asked_.store(restraint.asked, std::memory_order_relaxed);
    given_.store(restraint.given, std::memory_order_relaxed);
    if (reason_.load(std::memory_order_relaxed) == restraint.reason) return false;
    count_.store(count_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    reason_.store(restraint.reason, std::memory_order_release);
    return true;
  }

  /// There is one, or was within the last second. The component's thread.
  bool lasts_on() const noexcept { return reason_.load(std::memory_order_relaxed) != nullptr; }

  /// Any thread.
  Restraint read() const noexcept {
    Restraint restraint;
    restraint.reason = reason_.load(std::memory_order_acquire);
    restraint.asked = asked_.load(std::memory_order_relaxed);
    restraint.given = given_.load(std::memory_order_relaxed);
    return restraint;
  }
  std::uint64_t count() const noexcept { return count_.load(std::memory_order_relaxed); }

 private:
  static constexpr Duration lasts = std::chrono::seconds{1};

  std::atomic<const char*> reason_{nullptr};
  std::atomic<double> asked_{0};
  std::atomic<double> given_{0};
  std::atomic<std::uint64_t> count_{0};
  Time noted_at_{};
};

}  // namespace flexrf
