// What is counted of each release: lateness and execution apart, overruns, and whether their limit is
// reached.
#pragma once

#include "runtime/executive/overrun_log.hpp"
#include "runtime/executive/stepper.hpp"
#include "runtime/executive/trigger.hpp"

namespace flexrf {

/// Owning thread only.
class Accounting {
 public:
  Accounting(const ThreadRecord& record, ThreadState& state) noexcept
      : record_(&record), state_(&state), log_(record.name) {}

  struct Verdict {
    bool overrun = false;
    bool limit_reached = false;  ///< the thread's overrun policy or limit makes it a fault
  };

  /// Counts a release that ended at `ended`. The limits count time: a release that was left out counts as an
  /// overrun of its own.
  Verdict count(const Release& release, Time ended, std::uint64_t past_releases) noexcept;
  /// In every turn: says of overruns what is to be said by then; at the end, with Time::max(), the rest.
  void say(Time now) noexcept { log_.say(now); }

 private:
  const ThreadRecord* record_;
  ThreadState* state_;
  OverrunLog log_;
  std::uint64_t level_ = 0;  // consecutive overruns, or the leaky counter
  std::uint32_t good_ = 0;   // good releases since it last leaked
};

}  // namespace flexrf
