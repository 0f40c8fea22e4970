// What config-gen makes of an application's tables, whatever stands in them: messages that a person can use,
// in bounded time and number, and never an exception.
#pragma once

#include <string>
#include <vector>

#include "config-gen/tests/mutation.hpp"

namespace flexrf::config_gen::tests {

struct Judgement {
  bool accepted = false;  // no error: files would be written
  std::string wrong;      // what config-gen did that it must not; empty when it did all right
  Model model;
  std::vector<GeneratedFile> files;
};

Judgement judge(const Cell& cell);

// Ends the process with a report when config-gen crashes, or takes more than 2 s of processor. `number` and
// `mutation` tell with which tables; both stay in force until the next call.
void watch_for_crashes();
void watch(std::uint64_t number, const std::string& description);

}  // namespace flexrf::config_gen::tests
