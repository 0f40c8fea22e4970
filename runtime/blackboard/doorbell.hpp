// Doorbell: what a thread sleeps on. One per thread; whoever gives it a reason to look rings.
#pragma once

#include <atomic>
#include <cstdint>

#include "base/time.hpp"

namespace flexrf {

/// A level-triggered wake-up on one futex word: [rings 31..1 | somebody sleeps 0].
///
/// The sleeper reads the word with listen(), looks at everything it waits for, and sleeps with wait() on the
/// value it read: a ring in between makes wait() return at once, so none is lost (unless exactly 2^31 rings
/// fall between the two). Ringing makes no system call while nobody sleeps. `ring` may be called from any
/// thread and from a signal handler; everything else is the sleeper's, of which there is one.
class Doorbell {
 public:
  constexpr Doorbell() noexcept = default;
  Doorbell(const Doorbell&) = delete;
  Doorbell& operator=(const Doorbell&) = delete;

  void ring() noexcept {
    if ((word_.fetch_add(one_ring, std::memory_order_seq_cst) & asleep) != 0) wake();
  }

  /// The sleeper's first act: look at the word before looking at what it waits for.
  std::uint32_t listen() const noexcept { return word_.load(std::memory_order_seq_cst) & ~asleep; }

  /// Sleeps until rung after `heard`, or until `deadline` (Time::max(): for ever). True when rung. Not in
  /// descriptor mode.
  bool wait(std::uint32_t heard, Time deadline) noexcept;

  /// Descriptor mode, for a thread that waits on descriptors too: ringing writes to this non-blocking eventfd
  /// (−1: none). Set before the start. The sleeper listens, looks, announces, polls, settles.
  void use_descriptor(int event_descriptor) noexcept { event_descriptor_ = event_descriptor; }
  /// Descriptor mode: announces sleep. False when rung after `heard`: nothing to settle, no need to sleep.
  bool announce(std::uint32_t heard) noexcept;
  /// Descriptor mode: after waking; empties the eventfd.
  void settle() noexcept;

  /// So that tests can see the wrap-around. Before the start.
  void start_count_at(std::uint32_t rings) noexcept {
    word_.store(rings * one_ring, std::memory_order_relaxed);
  }

 private:
  static constexpr std::uint32_t asleep = 1;
  static constexpr std::uint32_t one_ring = 2;

  void wake() noexcept;

  std::atomic<std::uint32_t> word_{0};
  int event_descriptor_ = -1;
};

}  // namespace flexrf
