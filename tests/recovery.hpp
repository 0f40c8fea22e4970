// How soon a device is back once the cause of its absence is gone.
#pragma once

#include <cstdio>

#include "base/time.hpp"

namespace flexrf {

/// By the clock of the cycles where that is virtual or, in the guest, counts; never by a host's.
inline constexpr Duration longest_recovery = std::chrono::seconds(2);

/// Says how long it took as well.
inline bool is_back_in_time(const char* from, Duration took) {
  std::printf("back after %s: %.3f s\n", from, seconds(took));
  return took <= longest_recovery;
}

}  // namespace flexrf
