// What the server tells of itself.
#pragma once

#include <cstdint>

#include "base/time.hpp"

namespace flexrf::panel {

struct ServerFigures {
  std::uint32_t connections = 0;  ///< places in use
  std::uint32_t places = 0;
  std::uint64_t refused = 0;  ///< clients that found no place
  Duration loop_delay_p99{};  ///< how late the server's thread comes to a timer, since its start
  Duration loop_delay_max{};
  std::uint64_t slow_calls = 0;  ///< calls of handlers that took longer than 5 ms
};

}  // namespace flexrf::panel
