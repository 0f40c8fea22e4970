// Response-time analysis of periodic tasks under fixed priorities: an estimate of the longest time from
// release to completion, from declared budgets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "base/time.hpp"

namespace flexrf {

/// What a report says beside the numbers: budgets are declared, the kernel's own work is not in them.
inline constexpr const char* response_time_label =
    "estimate from declared budgets, kernel and interrupts left out";

struct ResponseTimeTask {
  const char* name = "";
  std::uint16_t cpu = 0;      ///< tasks of different CPUs do not disturb each other
  std::uint8_t priority = 0;  ///< higher runs first; equal ones are counted as disturbing each other
  Duration execution{};       ///< C: longest execution of one release
  Duration period{};          ///< T: shortest time between releases, > 0
  Duration jitter{};          ///< J: how much later than due a release may come
  Duration deadline{};        ///< D: of one release, from when it was due
};

struct ResponseTimeResult {
  /// Longest time from due to completion, jitter included; Duration::max() when it has no bound (the CPU is
  /// asked for more than it has), or none that was found in a bounded number of rounds.
  Duration response{};
  bool meets_deadline = false;
};

/// ResponseTimeAnalysis, as config-gen does it for the roles in the tables. Pure; any thread, not for
/// real-time paths.
/// @param results as many as tasks, same order.
/// @returns whether every task meets its deadline.
bool analyse_response_times(std::span<const ResponseTimeTask> tasks,
                            std::span<ResponseTimeResult> results) noexcept;

/// "control: response 1.250 ms, deadline 7.000 ms: met", labelled as an estimate; cut at capacity. @returns
/// text.
const char* describe_response_time(const ResponseTimeTask& task, const ResponseTimeResult& result, char* text,
                                   std::size_t capacity) noexcept;

}  // namespace flexrf
