// Which changes of tables a test makes, as whoever runs it says: PROGRAM [COUNT [FIRST]].
#pragma once

#include <cstdint>
#include <cstdlib>

namespace flexrf::config_gen::tests {

struct Numbers {
  std::uint64_t first = 0;
  std::uint64_t count = 0;

  void take(int argument_count, char** arguments) {
    if (argument_count > 1) count = std::strtoull(arguments[1], nullptr, 10);
    if (argument_count > 2) first = std::strtoull(arguments[2], nullptr, 10);
  }
};

}  // namespace flexrf::config_gen::tests
