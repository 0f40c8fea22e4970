// What a machine has and lacks for real time.
#pragma once

#include <string>
#include <vector>

#include "runtime/realtime/doctor/system_files.hpp"

namespace flexrf::doctor {

enum class Verdict {
  ok,
  warn,     ///< costs latency
  missing,  ///< without it no thread becomes real-time
};
const char* name_of(Verdict verdict) noexcept;

struct Finding {
  Verdict verdict;
  std::string check;    ///< one or two words
  std::string found;    ///< what there is
  std::string meaning;  ///< what it does to a cell; empty when ok
  std::string remedy;   ///< the exact command or line; empty when ok
};

/// All checks in order, from the rights to the details. `machine_file`: path below the root.
std::vector<Finding> examine(const SystemFiles& system, const std::string& machine_file);

}  // namespace flexrf::doctor
