// Releases: the rules of one thread's releases, the same for the wall clock and for virtual time: when the
// next is due, against which instant it is judged, and what follows from how long it took.
#pragma once

#include <vector>

#include "runtime/executive/accounting.hpp"
#include "runtime/executive/stepper.hpp"
#include "runtime/executive/trigger.hpp"

namespace flexrf {

/// Whoever drives the thread serves and steps by stepper(), and asks here before and after. All functions:
/// the thread that is released.
class Releases {
 public:
  Releases(Cell& cell, std::uint16_t thread);

  /// Before the first next(): what was published before does not release.
  void begin(Time start) noexcept { trigger_.begin(start); }
  /// When the thread is to be released, as far as is known at `now`; sooner than its trigger says while it
  /// needs attention. `readable`: the trigger's device has something.
  Due next(Time now, bool readable) noexcept;
  /// `due` begins at `now`: what it fired for does not release again.
  Release take(const Due& due, Time now) noexcept;
  /// It ended: left-out releases and overruns are counted, and at their limit its units are in fault. True:
  /// it was an overrun. One that was due before Control::judged_from() is not counted, and is none.
  bool finish(const Release& release, Time ended) noexcept;
  /// Logs of overruns and budgets what is to be logged by `now`; at the end, with Time::max(), the rest.
  void say(Time now) noexcept {
    accounting_.say(now);
    stepper_.say(now);
  }

  Stepper& stepper() noexcept { return stepper_; }
  const Stepper& stepper() const noexcept { return stepper_; }
  /// As Trigger's.
  int descriptor() const noexcept { return trigger_.descriptor(); }

 private:
  bool holds_items() const noexcept;

  const Control* control_;
  const ThreadRecord* record_;
  Stepper stepper_;
  std::vector<const UnitState*> takers_;  // units that take from queues which release the thread
  Trigger trigger_;
  Accounting accounting_;
};

}  // namespace flexrf
