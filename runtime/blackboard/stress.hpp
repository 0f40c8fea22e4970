// What the stress tests share: how long to run, and the first thing that went wrong in any thread.
#pragma once

#include <sched.h>

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <thread>

namespace flexrf::test {

/// Runs are counted, not timed: `few` items in a short run, 20 times as many with FLEXRF_LONG set.
inline std::uint64_t items(std::uint64_t few) {
  static const bool is_long = std::getenv("FLEXRF_LONG") != nullptr;
#ifdef FLEXRF_SANITIZER
  few /= 4;
#endif
  return is_long ? few * 20 : few;
}

/// The first complaint of any thread. Threads go on after complaining, so that all of them end.
class Complaint {
 public:
  void make(const char* text) noexcept {
    const char* none = nullptr;
    text_.compare_exchange_strong(none, text);
  }
  void unless(bool condition, const char* text) noexcept {
    if (!condition) make(text);
  }
  const char* text() const noexcept { return text_.load(); }

 private:
  std::atomic<const char*> text_{nullptr};
};

/// Passes the time between two looks at something that another thread changes. Spins until the kernel takes
/// the processor away, because on a loaded machine each yield costs a turn of all that wants to run. Yields
/// where there is a single processor, because the other thread cannot run beside this one.
inline void pass_time() noexcept {
  static const bool has_one_processor = [] {
    cpu_set_t allowed;
    return sched_getaffinity(0, sizeof(allowed), &allowed) == 0 && CPU_COUNT(&allowed) == 1;
  }();
  if (has_one_processor) std::this_thread::yield();
}

/// Every thread starts at once.
class Start {
 public:
  explicit Start(int threads) noexcept : missing_(threads) {}
  void wait() noexcept {
    missing_.fetch_sub(1);
    while (missing_.load() > 0) std::this_thread::yield();
  }

 private:
  std::atomic<int> missing_;
};

}  // namespace flexrf::test
