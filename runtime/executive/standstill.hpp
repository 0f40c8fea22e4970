// Standstill: time in which a thread, or the whole process, did nothing although it should have.
#pragma once

#include "runtime/executive/cell.hpp"

namespace flexrf {

/// A debugger, SIGSTOP, a hypervisor, a program of higher priority: whatever kept the thread from its work,
/// the machine went on meanwhile. From the application's `standstill_limit` on it is a fault that is counted,
/// logged and reported, and where the thread owns an actuator Stop motion is latched, so that nothing goes on
/// moving by itself. The thread that is judged; one that only finds out for another says so by its name.
class Standstill {
 public:
  /// `thread`: index, or no_index for the supervising thread, which stands for the whole process.
  Standstill(Cell& cell, std::uint16_t thread) noexcept;

  /// `missed`: how long it did nothing, or stayed in one step. True when that is a standstill; Stop motion is
  /// latched by then. Not before the application runs, and not in a stop that somebody asked for (job
  /// control).
  bool judge(Duration missed) noexcept;

 private:
  Cell* cell_;
  const char* name_;
  ThreadState* state_;
  bool actuates_;
};

}  // namespace flexrf
