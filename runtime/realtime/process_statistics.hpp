// What the kernel counts of the process and its threads, read from /proc by a thread that is not real-time.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>

#include "base/status.hpp"

namespace flexrf {

struct ThreadStatistics {
  std::uint64_t minor_faults = 0;          ///< pages mapped without reading a disk
  std::uint64_t major_faults = 0;          ///< pages read from a disk
  std::uint64_t voluntary_switches = 0;    ///< the thread slept or waited
  std::uint64_t involuntary_switches = 0;  ///< it was preempted
  int cpu = -1;                            ///< where it ran last
};

struct ProcessStatistics {
  std::size_t locked = 0;         ///< bytes
  std::size_t resident = 0;       ///< bytes
  std::size_t resident_peak = 0;  ///< bytes
  std::size_t mapped = 0;         ///< bytes of address space
  int threads = 0;
};

/// Of the thread with the kernel's number `id`. not_found when it is gone. `process`: folder in /proc. No
/// allocation, but system calls: not for real-time threads.
Result<ThreadStatistics> read_thread_statistics(pid_t id, const char* process = "/proc/self") noexcept;
Result<ProcessStatistics> read_process_statistics(const char* process = "/proc/self") noexcept;

}  // namespace flexrf
