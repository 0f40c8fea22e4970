// The trial application as the tests of its process see it: its command line, and what its drive writes.
#pragma once

#include <string>
#include <vector>

#include "runtime/executive/tests/checks.hpp"
#include "tests/applications/process.hpp"

namespace flexrf::whole::trial {

inline const std::string moving = "moving\n";
inline const std::string at_rest = "made safe at rest\nsafe\n";
inline const std::string while_moving = "made safe while moving\nsafe\n";
inline const std::string last_gasp = "last gasp: brake\n";

inline std::vector<std::string> command_line(const std::string& application,
                                             const std::vector<std::string>& more = {}) {
  std::vector<std::string> all{application, "--report", "report"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

inline std::string drive_log(const Folder& folder) {
  return contents_of(folder / "drive.log");
}

inline void wait_until_moving(const Folder& folder) {
  CHECK(wait_until([&] { return drive_log(folder) == moving; }));
}

}  // namespace flexrf::whole::trial
