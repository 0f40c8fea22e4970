// Standstill: time in which a thread, or the whole process, did nothing although it should have.
#pragma once

#include "runtime/executive/cell.hpp"

namespace flexrf {

/// A debugger, SIGSTOP, a hypervisor, a program of higher priority: whatever kept the thread from its work,
/// the machine went on meanwhile. From the application's `standstill_limit` on it is a fault that is counted,
/// logged and reported, and where the thread owns an actuator Stop motion is latched, so that nothing goes on
/// moving by itself. All functions: the thread that is judged.
class Standstill {
 public:
  /// `thread`: index, or no_index for the supervising thread, which stands for the whole process.
  Standstill(Cell& cell, std::uint16_t thread) noexcept;

  /// The thread did nothing, or stayed in one step, from `from` to `to`. True when that is a standstill; Stop
  /// motion is latched by then. Nothing is judged before the application runs. Time before
  /// Control::judged_from() does not count: job control stopped the process.
  bool judge(Time from, Time to) noexcept;

  /// A release that was due at `nominal` ended at `ended`; `overrun`: too late. A thread that owns an
  /// actuator and ends every release too late for standstill_limit, while motion is permitted, leads it no
  /// better than one that does nothing. True when that is so; Stop motion is latched by then. One release in
  /// time, or a moment without the permission, begins anew.
  bool judge_release(Time nominal, Time ended, bool overrun) noexcept;

 private:
  bool is_limit_reached(Duration missed) const noexcept;
  void tell(Duration missed, const char* what) noexcept;

  Cell* cell_;
  const char* name_;
  ThreadState* state_;
  bool actuates_;
  Time late_since_ = Time::max();  // when the first of the releases was due that ended too late; max: none
};

}  // namespace flexrf
