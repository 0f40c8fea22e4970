// Threads made the real-time way: every setting asked for explicitly, and read back before the thread's work
// begins.
#pragma once

#include <pthread.h>
#include <sys/types.h>

#include <atomic>
#include <cstddef>

#include "base/status.hpp"
#include "runtime/realtime/cpu_set.hpp"

namespace flexrf {

struct ThreadSettings {
  const char* name = "";       ///< the kernel shows the first 15 bytes
  int priority = 0;            ///< SCHED_FIFO 1-99; 0: SCHED_OTHER, whatever the creator is
  CpuSet cpus;                 ///< empty: every CPU the process may use
  void* stack = nullptr;       ///< page-aligned, its lowest page becomes the guard; null: one is allocated
  std::size_t stack_size = 0;  ///< bytes, guard included; 0 with a null stack: 256 KiB
};

/// One thread. start and join: a non-real-time thread, always the same one. The object outlives the thread.
class RunningThread {
 public:
  RunningThread() noexcept = default;
  RunningThread(const RunningThread&) = delete;
  RunningThread& operator=(const RunningThread&) = delete;
  ~RunningThread();  ///< joins

  /// Guards and prefaults the stack, creates the thread, reads back policy, priority, CPUs, stack and guard,
  /// and only then lets `body(argument)` begin. On a mismatch the thread ends without having begun.
  /// not_permitted: a right is missing (see probe_rights); internal: the kernel set something else than
  /// asked.
  Status start(const ThreadSettings& settings, void (*body)(void*), void* argument) noexcept;
  void join() noexcept;
  bool is_started() const noexcept { return started_; }
  /// The kernel's number, for /proc; 0 before the start.
  pid_t id() const noexcept { return id_; }
  pthread_t handle() const noexcept { return handle_; }

 private:
  static void* trampoline(void* self);
  Status create(const ThreadSettings& settings, const CpuSet& cpus) noexcept;
  Status read_back(const ThreadSettings& settings, const CpuSet& cpus) const noexcept;
  void finish() noexcept;

  pthread_t handle_{};
  pid_t id_ = 0;
  bool started_ = false;
  void (*body_)(void*) = nullptr;
  void* argument_ = nullptr;
  std::byte* stack_ = nullptr;  ///< guard included
  std::size_t stack_size_ = 0;
  bool stack_is_own_ = false;
  const void* frame_ = nullptr;  ///< somewhere in the thread's stack, for reading back
  std::atomic<pid_t> announced_{0};
  std::atomic<int> verdict_{0};
};

/// Smallest stack that start() takes, guard included, bytes.
std::size_t minimal_stack_size() noexcept;

}  // namespace flexrf
