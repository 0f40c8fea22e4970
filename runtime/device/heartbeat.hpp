// Heartbeat: whether every thread of the application is alive, for whoever tells the machine so.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>

#include "base/time.hpp"

namespace flexrf {

/// The supervising thread judges, whoever feeds a watchdog asks. A judgement holds for a second: when the
/// supervising thread itself hangs, the heartbeat is missed too.
class Heartbeat {
 public:
  static constexpr Duration holds_for = std::chrono::seconds{1};

  /// From now on somebody asks: the threads are looked after. Any thread.
  void watch() noexcept { watched_.store(true, std::memory_order_release); }
  bool is_watched() const noexcept { return watched_.load(std::memory_order_acquire); }

  /// Every thread has given a sign of life in its time. Any thread.
  bool is_met(Time now) const noexcept {
    return missed_by() == nullptr &&
           now - Time{Duration{judged_at_.load(std::memory_order_acquire)}} <= holds_for;
  }
  /// The thread or component that is silent, as the last judgement says; null: none is. Any thread.
  const char* missed_by() const noexcept { return missed_by_.load(std::memory_order_acquire); }

  /// The supervising thread. `missed_by`: a name from the application's tables, or null.
  void judge(Time now, const char* missed_by) noexcept {
    missed_by_.store(missed_by, std::memory_order_release);
    judged_at_.store(nanoseconds(now), std::memory_order_release);
  }

 private:
  std::atomic<bool> watched_{false};
  std::atomic<const char*> missed_by_{nullptr};
  std::atomic<std::int64_t> judged_at_{0};
};

}  // namespace flexrf
