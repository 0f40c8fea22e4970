// Sizes and times of the server.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "base/time.hpp"
#include "web-ui/server/access/address.hpp"

namespace flexrf::panel {

inline constexpr std::size_t header_limit = 8U << 10;         ///< bytes of a request's header
inline constexpr std::size_t body_limit = 64U << 10;          ///< bytes of a request's body
inline constexpr std::size_t live_message_limit = 16U << 10;  ///< bytes of a client's message

struct ServerSettings {
  /// Connections at a time. A quarter is for who is local; one address that is not has three quarters of the
  /// rest at most. Who has nothing to say makes room for who comes.
  std::uint32_t places = 32;
  std::vector<Address> local;  ///< at the machine, beside loopback
  /// What a body may be. Pages of others cannot send JSON or bytes without asking first; a form they can, so
  /// who takes forms has to know its own.
  std::vector<std::string_view> body_types{"application/json"};
  bool loopback_is_local = true;  ///< else it is where a tunnel or a proxy ends
  Duration header_timeout = std::chrono::seconds{5};
  Duration body_timeout = std::chrono::seconds{10};
  Duration idle_timeout = std::chrono::seconds{15};   ///< between two requests
  Duration reply_timeout = std::chrono::seconds{60};  ///< of a handler that answers later
  Duration write_timeout = std::chrono::seconds{5};   ///< of a client that does not read
  Duration linger_timeout = std::chrono::seconds{1};  ///< for the client's side of an end
  /// A live connection on which neither a message nor a ping came for this long is closed. The client's holds
  /// have ended before, by their leases. A shorter limit would close pages on busy computers again and again.
  Duration live_silence = std::chrono::seconds{3};
  std::uint32_t live_message_rate = 2000;             ///< messages and pings a second of one client
  Duration slow_call = std::chrono::milliseconds{5};  ///< what no handler may take
};

}  // namespace flexrf::panel
