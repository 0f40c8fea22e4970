// Job control: Ctrl-Z and what else stops the process for a while. A machine is brought to hold first.
#pragma once

#include "runtime/executive/cell.hpp"

namespace flexrf {

/// Nobody steps, answers a drive or feeds a watchdog while the process is stopped. So every actuator is
/// inhibited before, in a cycle of its own thread, the terminal is given back, and nothing moves afterwards
/// before a Start. The supervising thread.
class JobControl {
 public:
  explicit JobControl(Cell& cell) noexcept : cell_(&cell) {}

  /// Stops the process as `signal` wants it (signals::stopping); returns when it is continued.
  void stop(int signal) noexcept;

 private:
  /// Until every thread has seen what was asked and acted on it, or for a quarter of a second.
  void let_threads_act() const noexcept;

  Cell* cell_;
};

}  // namespace flexrf
