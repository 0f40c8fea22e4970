// Budget watch: tells of units whose steps take more than their declared budget.
#pragma once

#include <cstdint>

#include "base/time.hpp"
#include "runtime/executive/application.hpp"

namespace flexrf {

/// The clock says how long a step took, with the time in which other threads had the processor. So a step
/// that exceeds its budget by the clock only makes the next release measured: by the processor time of its
/// own thread, and by whether it waited. What exceeds its budget by that is counted and logged: the first at
/// once, the others as a sum every 10 s. A release that is not measured costs a comparison for each unit.
///
/// Watches threads with a priority: elsewhere budgets promise nothing. Owning thread only; no allocation.
class BudgetWatch {
 public:
  BudgetWatch(const Application& application, const ThreadRecord& thread) noexcept
      : application_(&application), thread_(&thread) {}

  /// Before the first step of a release.
  void begin() noexcept;
  /// After a step of `unit` (its index) that ended at `ended` and took so long by the clock.
  void note(std::uint16_t unit, Duration took, Time ended) noexcept;
  /// In every turn: logs the sum when its time has come. At the thread's end `now` is Time::max().
  void say(Time now) noexcept;

 private:
  struct Usage {
    Duration processor{};
    long waits = 0;
  };

  static Usage usage_of_this_thread() noexcept;

  const Application* application_;
  const ThreadRecord* thread_;
  bool suspects_ = false;  // a step of this release exceeds its budget by the clock
  bool measures_ = false;  // one of the release before did
  Usage usage_;            // while it measures: when the step began
  Time say_at_{};          // the next sum; 0: nothing was logged yet
  std::uint64_t exceeded_ = 0;
  Duration longest_{};  // of these, beyond the budget
  std::uint16_t longest_unit_ = 0;
};

}  // namespace flexrf
