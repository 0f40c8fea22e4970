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
  Time at = Time::max();    ///< max: not before somebody rings
  std::uint32_t fired = 0;  ///< bit n: the n-th source advanced; of a device bit 0: it has something by now
  bool timed_out = false;
};

/// Refuses threads that wait for more than Trigger::max_sources. Before any Trigger of the application
/// begins.
Status check_triggers(const Application& application);

/// All functions: the thread that is triggered.
class Trigger {
 public:
  static constexpr std::size_t max_sources = 32;

  Trigger(const TriggerRecord& record, const Application& application) noexcept;

  /// The first release is due at start + phase; what was published before does not fire.
  void begin(Time start) noexcept;

  /// When the next release is due as far as is known at `now`. `readable`: the trigger's device has
  /// something. With back-off this is a poll: it finds something or says when to look again.
  Due due(Time now, bool readable) noexcept;

  /// A release begins: what the last due() saw is its, and will not fire again. What was published since then
  /// is of the next release, which is told of it.
  void released(Time nominal, Time now) noexcept;

  /// A periodic release ended at `ended`: how many further releases lie in the past by now; they are left out
  /// unless the policy is catch_up.
  std::uint64_t finished(Time ended, OverrunPolicy policy) noexcept;

  Time last_release() const noexcept { return last_; }
  /// What it learned, where it polls by back-off.
  const Backoff& backoff() const noexcept { return backoff_; }
  /// Descriptor whose readability releases the thread, or −1.
  int descriptor() const noexcept;

 private:
  std::uint64_t count_of(std::size_t source) const noexcept;
  std::uint32_t advanced() noexcept;
  const Device* owned_device() const noexcept;  // null while the lifecycle thread has it
  Due due_by_sources(Time now) noexcept;
  Due due_by_device(Time now, bool readable) const noexcept;
  Due due_by_backoff(Time now) noexcept;
  void add_timeout(Due& due) const noexcept;

  const TriggerRecord* record_;
  const Application* application_;
  std::array<std::uint64_t, max_sources> cursors_{};  // publications that had their release
  std::array<std::uint64_t, max_sources> seen_{};     // publications when due() looked last
  Backoff backoff_;
  Time poll_at_{};
  bool found_ = false;  // back-off: a poll found items, the release is still to come
  Time next_{};
  Time last_{};
};

}  // namespace flexrf
