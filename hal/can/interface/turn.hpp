// Turn: one of two threads at a time, and only the one that may wait does.
#pragma once

#include <atomic>
#include <chrono>
#include <thread>

namespace flexrf {

/// For what a cyclic thread goes through in each cycle and the lifecycle thread changes now and then.
class Turn {
 public:
  /// The cyclic thread: false when the other one is at it; then it leaves it for this cycle.
  bool try_take() noexcept { return !taken_.exchange(true, std::memory_order_acquire); }
  /// The lifecycle thread: the cyclic one is done within microseconds, if it has a processor.
  void take() noexcept {
    while (!try_take()) std::this_thread::sleep_for(std::chrono::microseconds{50});
  }
  void give_back() noexcept { taken_.store(false, std::memory_order_release); }

 private:
  std::atomic<bool> taken_{false};
};

}  // namespace flexrf
