// What this process may ask of the kernel, looked at before asking, and how to get what is missing.
#pragma once

#include <cstddef>

#include "base/status.hpp"

namespace flexrf {

struct RightsNeeded {
  int priority = 0;              ///< highest SCHED_FIFO priority of any thread; 0: none
  std::size_t locked_bytes = 0;  ///< memory to be locked; 0: none
};

struct RightsReport {
  bool priority_missing = false;
  bool lock_missing = false;
  /// Several lines: which right is missing, of whom, and how to grant it. Empty when nothing is missing.
  char text[1600] = {};
  char summary[200] = {};  ///< the missing rights in one line

  bool is_complete() const noexcept { return !priority_missing && !lock_missing; }
  /// not_permitted with the missing rights in one line.
  Status status() const noexcept;
};

/// Finds out whether the process has the rights. Non-real-time thread; may allocate. The calling
/// thread is SCHED_FIFO for an instant and then what it was.
RightsReport probe_rights(const RightsNeeded& needed);

/// Locks all memory of the process, now and later, faults it in, and reads back that it is so. Non-real-time
/// thread, before real-time threads start. (Sanitizers leave memory unlocked: ok without effect.)
Status lock_all_memory() noexcept;

}  // namespace flexrf
