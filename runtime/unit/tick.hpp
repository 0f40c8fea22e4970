// What a step is told about itself.
#pragma once

#include <cstdint>

#include "base/time.hpp"

namespace flexrf {

struct Tick {
  Time nominal{};                 ///< when the step was due
  Time now{};                     ///< when it began; stamps what it publishes
  Duration lateness{};            ///< now - nominal
  Duration elapsed{};             ///< since this unit's step before, 0 at its first
  std::uint64_t number = 0;       ///< steps of this unit before this one
  std::uint32_t fired = 0;        ///< bit n: the trigger's n-th source fired, or items wait in that queue
  bool timed_out = false;         ///< released by the trigger's timeout, or without it to see a stop
  bool finishing = false;         ///< no more input will come: complete what is begun
  bool stop_requested = false;    ///< controlled stop: come to rest within stop_timeout, then be idle
  bool motion_inhibited = false;  ///< no actuator of this application may be moved now
  Time permitted_since{};         ///< the Start by which they may; no time: from power-on

  /// Whether an actuator may be led by what was asked for then: not by what is from before the
  /// Start [stop-96].
  bool may_follow(Time asked_at) const noexcept { return !motion_inhibited && asked_at >= permitted_since; }
};

}  // namespace flexrf
