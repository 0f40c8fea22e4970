// Supervision: brings the application from running to its end, step by step, and notices what goes wrong.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/executive/cell.hpp"
#include "runtime/executive/lifecycle.hpp"
#include "runtime/executive/missed_time.hpp"

namespace flexrf {

/// Only ever looks at what the threads publish of themselves. One non-real-time thread calls it every few
/// milliseconds; in virtual time the scheduler does, after events.
class Supervision {
 public:
  Supervision(Cell& cell, Lifecycle& lifecycle, bool watch_for_hangs) noexcept;

  /// Raises the mode where it is time to.
  void observe(Time now) noexcept;

  /// A unit or device is or was in fault, a thread hung, an operation of the lifecycle thread took too long.
  bool had_fault() const noexcept { return had_fault_; }
  /// A thread or the lifecycle thread does not answer: the process can only be left, not wound up.
  bool is_stuck() const noexcept { return stuck_; }
  /// finish_timeout or stop_timeout ended a phase, not the units' coming to rest.
  bool was_cut_short() const noexcept { return cut_short_; }

  /// A thread whose step does not return for this long hangs: its hang_timeout, else 500 ms, or 20 deadlines
  /// where that is longer. Time in which nobody watched does not count.
  static Duration hang_timeout(const ThreadRecord& thread) noexcept;

 private:
  /// A step that has begun, as far as it was watched.
  struct Step {
    std::int64_t began = 0;
    Time seen_at{};
  };

  void watch_faults() noexcept;
  void watch_hangs(Time now, Duration missed) noexcept;
  bool hangs(std::size_t thread, Time now, Duration missed) noexcept;
  bool is_overdue(const Lifecycle::Operation& operation, Time now, Duration missed) noexcept;
  void give_up() noexcept;
  void finish(Time now) noexcept;
  void stop(Time now) noexcept;
  void make_safe(Time now) noexcept;
  bool an_event_is_handled() const noexcept;
  bool is_quiet() const noexcept;
  bool units_are_idle() const noexcept;
  void enter(Mode mode, Time now) noexcept;
  void begin_phase(Mode mode, Time now) noexcept;
  void note_quiet(bool quiet, Time now) noexcept;
  bool has_settled(Time now) const noexcept;

  Cell* cell_;
  Lifecycle* lifecycle_;
  bool watch_for_hangs_;
  MissedTime missed_time_;
  std::vector<Step> steps_;  // of each thread, the present one
  Time operation_overdue_at_{};
  Duration operation_missed_{};
  Duration settle_time_{};
  /// How long devices have to become safe before the process ends all the same: no shorter than a step that
  /// does not hang yet.
  Duration safe_timeout_;
  Mode mode_ = Mode::starting;
  Time entered_at_{};                             // the present mode
  bool was_quiet_ = false;                        // nothing was under way at the last look
  Time quiet_since_{};                            // while so: the first look of which that is true
  std::vector<std::uint64_t> cycles_when_quiet_;  // of each thread, at that time
  bool had_fault_ = false;
  bool stuck_ = false;
  bool cut_short_ = false;
};

}  // namespace flexrf
