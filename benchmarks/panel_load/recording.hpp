// What the units of this application tell the benchmark that runs it, in memory that both share.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "base/status.hpp"

namespace flexrf {

/// A file of this size, zeroed, whose path stands in the environment.
struct Recording {
  static constexpr const char* variable = "FLEXRF_BENCH_RECORDING";
  static constexpr std::size_t most_releases = 12'000;

  std::atomic<std::uint64_t> steps;      ///< of the control thread
  std::atomic<std::uint64_t> releases;   ///< that are noted below; once full, no more are
  std::atomic<std::int64_t> began_at;    ///< CLOCK_MONOTONIC ns, when the command last rose from zero
  std::atomic<std::int64_t> fell_at;     ///< when it last began to fall
  std::atomic<std::uint64_t> pictures;   ///< that were published
  std::int64_t lateness[most_releases];  ///< ns
};

/// Of the file that the environment names; where it names none, of no file. The same for all of a process.
/// Initialisation only.
Result<Recording*> open_recording() noexcept;

}  // namespace flexrf
