// What passes between the driver of a process and the helper that starts it: one packet each.
#pragma once

#include <sched.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/status.hpp"

namespace flexrf {

struct ProcessProgram;

enum class SpawnVerb : std::uint8_t { start, end_politely, end_at_once };

/// To the helper. Of all but `start` only the verb is sent.
struct SpawnOrder {
  static constexpr std::size_t max_words = 128;

  SpawnVerb verb = SpawnVerb::start;
  cpu_set_t cpus{};  ///< that the program may use
  std::uint16_t arguments = 0;
  std::uint16_t variables = 0;
  std::uint16_t size = 0;  ///< of `words`
  /// Each ends with a zero: executable, directory, arguments, variables.
  std::array<char, 4096> words{};

  /// invalid_argument: it is too long.
  Status set(const ProcessProgram& program) noexcept;
  std::size_t bytes() const noexcept { return offsetof(SpawnOrder, words) + size; }
};

/// From the helper; `started` comes with three descriptors: input, output, error.
struct SpawnReport {
  enum class Kind : std::uint8_t { started, refused, ended };
  enum class Stage : std::uint8_t { pipe, fork, directory, execute };

  Kind kind = Kind::started;
  Stage stage = Stage::pipe;  ///< at which it was refused
  int error = 0;              ///< errno of that
  int id = 0;                 ///< of what started
  int status = 0;             ///< of what ended, as waitpid gives it
  std::int64_t at = 0;        ///< ns on CLOCK_MONOTONIC
};

}  // namespace flexrf
