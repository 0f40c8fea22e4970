// What the stress tests share: how long to run, and the first thing that went wrong in any thread.
#pragma once

#include <atomic>
#include <chrono>
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

/// Leaves the processor to another for a moment. Not by sched_yield: threads that do little else than yield
/// to each other have kept all others off their processor for minutes (Linux 6.18).
inline void give_way() {
  std::this_thread::sleep_for(std::chrono::microseconds{1});
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

/// Every thread starts at once.
class Start {
 public:
  explicit Start(int threads) noexcept : missing_(threads) {}
  void wait() {
    missing_.fetch_sub(1);
    while (missing_.load() > 0) give_way();
  }

 private:
  std::atomic<int> missing_;
};

}  // namespace flexrf::test
