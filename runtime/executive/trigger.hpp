// Trigger: when a thread is to be released next. The same for the wall clock and for virtual time.
#pragma once

#include <array>
#include <cstdint>

#include "base/status.hpp"
#include "runtime/executive/application.hpp"
#include "runtime/executive/backoff.hpp"

namespace flexrf {

/// What is known of a thread's next release.
struct Due {
  Time at = Time::max();  ///< max: not before somebody rings
  /// Bit n: the n-th source advanced, or items wait in it that the thread may take; of a device bit 0: it has
  /// something by now.
  std::uint32_t fired = 0;
  bool timed_out = false;
};

/// Refuses threads that wait for more than Trigger::max_sources. Before any Trigger of the application
/// begins.
Status check_triggers(const Application& application);

/// What a step leaves in a queue releases its thread again, without a new arrival: after a step that took
/// something `min_interval` after that release (back-off: `shortest`), so that a burst is worked off one by
/// one. A step that took nothing may not want to for long. What waits is then offered in growing pauses: it
/// is never forgotten, and not even a thread without min_interval turns in circles. Where a queue has several
/// readers, what another takes during a step counts as taken by it, too: one step more for each such item.
///
/// All functions: the thread that is triggered.
class Trigger {
 public:
  static constexpr std::size_t max_sources = 32;
  /// Pauses from one step that took nothing of what waits to the next: the first, then twice as long each
  /// time, up to the longest; none is shorter than min_interval. Back-off has its own, `shortest` and
  /// `longest`.
  static constexpr Duration first_pause = std::chrono::milliseconds{1};
  static constexpr Duration longest_pause = std::chrono::milliseconds{16};

  /// `own_queues`: bit n: the n-th source is a queue that the thread's own units or devices take from. What
  /// waits in others is not for this thread.
  Trigger(const TriggerRecord& record, const Application& application, std::uint32_t own_queues) noexcept;

  /// The first release is due at start + phase; what was published before does not fire, but what waits in a
  /// queue is offered.
  void begin(Time start) noexcept;

  /// When the next release is due as far as is known at `now`. `readable`: the trigger's device has
  /// something. `holds_items`: a unit has taken from an own queue what it could not complete yet; that waits
  /// as if it were still in the queue. With back-off this is a poll: it finds something or says when to look
  /// again.
  Due due(Time now, bool readable, bool holds_items = false) noexcept;

  /// A release begins: what the last due() saw is its, and will not fire again. What was published since then
  /// is of the next release, which is told of it.
  void released(Time nominal, Time now) noexcept;

  /// A periodic release ended at `ended`: how many further releases lie in the past by now; they are left out
  /// unless the policy is catch_up.
  std::uint64_t finished(Time ended, OverrunPolicy policy) noexcept;

  /// Releases of a period that were due before `time` are left out, whatever the policy: job control stopped
  /// the process.
  void leave_out_before(Time time) noexcept;

  Time last_release() const noexcept { return last_; }
  /// What it learned, where it polls by back-off.
  const Backoff& backoff() const noexcept { return backoff_; }
  /// Descriptor whose readability releases the thread, or −1.
  int descriptor() const noexcept;

 private:
  std::uint64_t count_of(std::size_t source) const noexcept;
  std::uint32_t advanced() noexcept;
  const Device* owned_device() const noexcept;  // null while the lifecycle thread has it
  Due due_by_sources(Time now, bool holds_items) noexcept;
  Due due_by_device(Time now, bool readable) const noexcept;
  Due due_by_backoff(Time now, bool holds_items) noexcept;
  void add_timeout(Due& due) const noexcept;
  std::uint64_t taken() const noexcept;
  std::uint32_t waiting(bool holds_items) const noexcept;
  std::uint32_t left_behind(Time now, bool holds_items) noexcept;

  const TriggerRecord* record_;
  const Application* application_;
  std::array<std::uint64_t, max_sources> cursors_{};  // publications that had their release
  std::array<std::uint64_t, max_sources> seen_{};     // publications when due() looked last
  std::uint32_t own_queues_;                          // by bits, as fired
  bool judged_ = false;                               // the last release's step: what it left is known
  std::uint32_t left_ = 0;                            // own queues in which it left something
  std::uint64_t taken_ = 0;                           // from all own queues, as of the last release
  Duration pause_{};  // after the last step that took nothing of what waited; 0: it took some
  Time offer_at_{};   // when what is left releases
  Backoff backoff_;
  Time poll_at_{};
  bool found_ = false;  // back-off: a poll found items, the release is still to come
  Time next_{};
  Time last_{};
};

}  // namespace flexrf
