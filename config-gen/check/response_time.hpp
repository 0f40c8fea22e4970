// Response-time analysis for fixed priorities on one CPU.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace flexrf::config_gen {

struct Task {
  int priority = 0;           // higher runs first; equal ones delay each other
  std::int64_t demand = 0;    // longest execution, nanoseconds
  std::int64_t interval = 0;  // shortest time between releases, above 0
  std::int64_t jitter = 0;    // of the release
  std::int64_t deadline = 0;  // at most the interval
};

// The longest time from release to completion of `tasks[index]`: the smallest R with
//   R = C + sum over tasks of no lower priority of ceil((R + J) / T) C
// plus its own jitter (Joseph, Pandya 1986; Audsley et al. 1993). Nothing when it exceeds `limit`.
std::optional<std::int64_t> response_time(const std::vector<Task>& tasks, std::size_t index,
                                          std::int64_t limit);

}  // namespace flexrf::config_gen
