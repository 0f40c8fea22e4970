// What is counted of each release: lateness and execution apart, overruns, and whether their limit is
// reached.
#pragma once

#include "runtime/executive/stepper.hpp"
#include "runtime/executive/trigger.hpp"

namespace flexrf {

/// Owning thread only.
class Accounting {
 public:
  Accounting(const ThreadRecord& record, ThreadState& state) noexcept : record_(&record), state_(&state) {}

  /// Counts a release that ended at `ended`. True when the thread's overrun policy or limit makes it a fault.
  bool count(const Release& release, Time ended, std::uint64_t past_releases) noexcept;

 private:
  const ThreadRecord* record_;
  ThreadState* state_;
  std::uint32_t level_ = 0;  // consecutive overruns, or the leaky counter
  std::uint32_t good_ = 0;   // good releases since it last leaked
};

}  // namespace flexrf
