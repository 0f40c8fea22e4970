// What the command flexrf-boot-choice does, apart from finding its files.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "image/boot/choice.hpp"
#include "image/boot/medium.hpp"

namespace flexrf::boot {

/// Exit codes. RAUC knows success and failure.
enum class Exit : int {
  done = 0,
  usage = 1,     ///< no such verb, or not these arguments
  repaired = 2,  ///< `repair` found something damaged; it is whole again
  failed = 3,    ///< something cannot be read, written or locked
  refused = 4,   ///< the state does not allow it
};

struct Outcome {
  Exit exit = Exit::done;
  std::string answer;             ///< for standard output, with line feeds
  std::vector<std::string> said;  ///< for a person: lines for the journal, without line feeds
};

/// What is wrong about a verb and its arguments, whatever the state is.
std::optional<std::string> misuse_of(const std::vector<std::string>& words);

/// `words`: the verb and its arguments. Nobody else may use the medium meanwhile.
Outcome perform(const std::vector<std::string>& words, Medium& medium, const Running& running);

/// Verbs and their arguments, with line feeds.
extern const char* const verbs_help;

}  // namespace flexrf::boot
