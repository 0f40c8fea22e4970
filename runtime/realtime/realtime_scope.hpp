// Marks stretches of a thread in which nothing may be allocated or freed; the allocation guard watches them.
#pragma once

#include <atomic>
#include <cstdint>

namespace flexrf {

/// How often a thread allocated or freed in a RealtimeScope. Written by that thread, read by any.
using AllocationCounter = std::atomic<std::uint64_t>;

/// While it lives, its thread may neither allocate nor free: the checked build aborts with a backtrace,
/// others count into `counter`. Scopes nest; the innermost counts. Without the guard's object in the
/// executable (FlexRF::allocation_guard; never under sanitizers) it has no effect.
class RealtimeScope {
 public:
  // Not inline: a compiler takes malloc not to look at any variable, and would drop what is set before it.
  explicit RealtimeScope(AllocationCounter& counter) noexcept;
  ~RealtimeScope();
  RealtimeScope(const RealtimeScope&) = delete;
  RealtimeScope& operator=(const RealtimeScope&) = delete;

 private:
  AllocationCounter* outer_;
};

/// While it lives, its thread may allocate again, for a stretch in which it is known not to matter.
class AllocationAllowed {
 public:
  AllocationAllowed() noexcept;
  ~AllocationAllowed();
  AllocationAllowed(const AllocationAllowed&) = delete;
  AllocationAllowed& operator=(const AllocationAllowed&) = delete;

 private:
  AllocationCounter* outer_;
};

/// Whether the guard was linked into this executable.
bool has_allocation_guard() noexcept;
/// Loads what the guard's backtrace needs, so that it is there when the guard fires. At start, any thread.
void prepare_allocation_guard() noexcept;

// ---- for the guard

namespace detail {
// Initial-exec: reading it never allocates, not even for the first time in a thread.
extern constinit thread_local AllocationCounter* allocation_counter [[gnu::tls_model("initial-exec")]];
}  // namespace detail

}  // namespace flexrf
