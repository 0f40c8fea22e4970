// The extent of a test that could go on without end. `flexrf test` sets it by FLEXRF_LONG.
#pragma once

#include <cstddef>
#include <cstdio>
#include <cstdlib>

namespace flexrf {

struct TestExtent {
  bool some = false;   ///< `--full` (FLEXRF_LONG=1): a few minutes more than in every run
  unsigned part = 0;   ///< `--soak` (FLEXRF_LONG="part 3 of 20"): one part of the campaign, from 1 on
  unsigned parts = 0;  ///< 0: not a part of a campaign

  /// Whether the part has the case of this number.
  bool has(std::size_t number) const { return parts != 0 && number % parts == part - 1; }

  static TestExtent of_environment() {
    const char* const text = std::getenv("FLEXRF_LONG");
    TestExtent extent;
    if (text == nullptr) return extent;
    const bool is_part = std::sscanf(text, "part %u of %u", &extent.part, &extent.parts) == 2 &&
                         extent.part >= 1 && extent.part <= extent.parts;
    if (!is_part) extent = {.some = true};
    return extent;
  }
};

}  // namespace flexrf
