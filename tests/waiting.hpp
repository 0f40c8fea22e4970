// How a test waits for another thread or process: for what it does, never for a time.
#pragma once

#include <chrono>
#include <thread>

namespace flexrf::test {

/// Ends a test that hangs. A busy machine does not exceed it.
inline constexpr std::chrono::minutes hang_limit{2};

/// Looks at the condition again and again until it holds. False: the hang limit has passed.
template <class Condition>
bool wait_until(Condition condition,
                std::chrono::microseconds between_looks = std::chrono::microseconds{200}) {
  const auto give_up = std::chrono::steady_clock::now() + hang_limit;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > give_up) return false;
    if (between_looks.count() > 0) std::this_thread::sleep_for(between_looks);
  }
  return true;
}

}  // namespace flexrf::test
