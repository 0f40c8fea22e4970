// The loop of one thread on the wall clock: wait for a reason, serve, step, count.
#pragma once

#include <cstddef>
#include <memory>

#include "runtime/executive/releases.hpp"
#include "runtime/executive/standstill.hpp"

namespace flexrf {

/// Constructed before its thread starts; run() is the thread's body.
class ThreadLoop {
 public:
  ThreadLoop(Cell& cell, std::uint16_t thread);
  ThreadLoop(const ThreadLoop&) = delete;
  ThreadLoop& operator=(const ThreadLoop&) = delete;
  ~ThreadLoop();

  /// Opens what the wait needs. Lifecycle or main thread, before run().
  Status prepare();
  /// Until the application's mode is `ended`.
  void run() noexcept;

 private:
  void watch_system_calls() noexcept;
  void turn(std::uint32_t heard) noexcept;
  void release(const Due& due, Time now) noexcept;
  Time due_since(const Release& release) const noexcept;
  void wait(std::uint32_t heard, Time until) noexcept;
  void wait_with_descriptor(std::uint32_t heard, Time until, int descriptor) noexcept;

  Cell* cell_;
  const ThreadRecord* record_;
  Releases releases_;
  Standstill standstill_;
  std::unique_ptr<std::byte[]> handler_stack_;  // for crash signals
  int event_descriptor_ = -1;
  bool readable_ = false;
};

}  // namespace flexrf
