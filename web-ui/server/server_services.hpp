// What the server offers to those who handle requests and live connections, beside sockets.
#pragma once

#include <cstdint>

#include "runtime/core/time.hpp"

namespace flexrf::panel {

struct ServerFigures {
  std::uint32_t connections = 0;  ///< places in use
  std::uint32_t places = 0;
  std::uint64_t refused = 0;  ///< clients that found no place
  Duration loop_delay_p99{};  ///< how late the server's thread comes to a timer, since its start
  Duration loop_delay_max{};
  std::uint64_t slow_calls = 0;  ///< calls of handlers that took longer than 5 ms
};

/// Whatever is to be done from time to time: what is due is sent, what ran out is ended, work of other
/// threads is fetched. The server's thread; both return within 5 ms.
class Ticked {
 public:
  /// When until_next() has passed, soon after each handled request or message, and at least each 100 ms.
  virtual void on_tick(Time now) = 0;
  /// Until there is something to do; zero: at once, but others first.
  virtual Duration until_next(Time now) const = 0;

 protected:
  ~Ticked() = default;
};

}  // namespace flexrf::panel
