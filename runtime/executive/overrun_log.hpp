// What is said of overruns: the first at once, the others as a sum now and then.
#pragma once

#include <cstdint>

#include "base/time.hpp"

namespace flexrf {

/// One thread's; owning thread only. No system call, no allocation.
class OverrunLog {
 public:
  explicit OverrunLog(const char* thread) noexcept : thread_(thread) {}

  /// A release that ended so long after its deadline (or after the next release was due), and left out so
  /// many.
  void note(Time now, Duration late, std::uint64_t skipped, Duration skipped_time) noexcept;
  /// In every turn: says the sum when its time has come. At the thread's end `now` is Time::max().
  void say(Time now) noexcept;

 private:
  const char* thread_;
  Time say_at_{};  // the next sum; 0: nothing was said yet
  std::uint64_t overruns_ = 0;
  std::uint64_t skipped_ = 0;
  Duration skipped_time_{};
  Duration latest_{};
};

}  // namespace flexrf
