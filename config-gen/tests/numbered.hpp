// Which changes of tables a test makes: by default, by PROGRAM [COUNT [FIRST]], or as part of a campaign.
#pragma once

#include <cstdint>
#include <cstdlib>

#include "tests/test_extent.hpp"

namespace flexrf::config_gen::tests {

struct Numbers {
  std::uint64_t first = 0;
  std::uint64_t count = 0;

  // Selects the part of the campaign that FLEXRF_LONG names, if it names one: numbers that no other run uses.
  void take_campaign(std::uint64_t in_each_part) {
    const TestExtent extent = TestExtent::of_environment();
    if (extent.parts == 0) return;
    constexpr std::uint64_t beyond = 1'000'000'000;
    count = in_each_part;
    first = beyond + extent.part * beyond;
  }

  void take(int argument_count, char** arguments) {
    if (argument_count > 1) count = std::strtoull(arguments[1], nullptr, 10);
    if (argument_count > 2) first = std::strtoull(arguments[2], nullptr, 10);
  }
};

}  // namespace flexrf::config_gen::tests
