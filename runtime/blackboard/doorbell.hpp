// Doorbell: what a thread sleeps on. One per thread; whoever gives it a reason to look rings.
#pragma once

#include <atomic>
#include <cstdint>

#include "runtime/core/time.hpp"

namespace flexrf {

/// A level-triggered wake-up on one futex word: [rings 31..1 | somebody sleeps 0].
///
/// The sleeper reads the word with listen(), looks at everything it waits for, and sleeps with wait() on the
/// value it read: a ring in between makes wait() return at once, so none is lost. Ringing makes no system
/// call while nobody sleeps. `ring` may be called from any thread and from a signal handler.
class Doorbell {
 public:
  constexpr Doorbell() noexcept = default;
  Doorbell(const Doorbell&) = delete;
  Doorbell& operator=(const Doorbell&) = delete;

  void ring() noexcept {
    if (word_.fetch_add(2, std::memory_order_seq_cst) & 1U) wake();
  }

  /// The sleeper's first act: look at the word before looking at what it waits for.
  std::uint32_t listen() const noexcept { return word_.load(std::memory_order_seq_cst) & ~1U; }

  /// Sleeps until rung after `heard`, or until `deadline` (Time::max(): for ever). True when rung.
  bool wait(std::uint32_t heard, Time deadline) noexcept;

  /// For a thread that waits on descriptors too: ringing writes to this eventfd (−1: none). Set before the
  /// start.
  void use_descriptor(int event_descriptor) noexcept { event_descriptor_ = event_descriptor; }
  /// Descriptor mode: announces sleep; false when rung after `heard` and there is no need to sleep.
  bool announce(std::uint32_t heard) noexcept;
  /// Descriptor mode: after waking.
  void settle() noexcept;

  void start_count_at(std::uint32_t rings) noexcept { word_.store(rings << 1, std::memory_order_relaxed); }

 private:
  void wake() noexcept;

  std::atomic<std::uint32_t> word_{0};
  int event_descriptor_ = -1;
};

}  // namespace flexrf
