// What the server asks of access control before a request reaches its handler.
#pragma once

#include <cstdint>
#include <string_view>

#include "web-ui/server/access/address.hpp"
#include "web-ui/server/exchange.hpp"

namespace flexrf::panel {

/// A request whose header is complete. Views are valid while the call runs; what is absent is empty.
struct Approach {
  std::uint32_t place = 0;  ///< of the connection
  Method method = Method::get;
  std::string_view path;   ///< percent-decoded, without query
  std::string_view query;  ///< as sent, without '?'
  std::string_view host;   ///< never empty
  std::string_view origin;
  std::string_view cookie;
  std::string_view remote_address;  ///< numeric
  Address local_end;                ///< of ours, where the connection arrived
  bool loopback = false;            ///< the remote end is this machine
  bool has_fetch_site = false;      ///< Sec-Fetch-Site is there: a browser asks
  bool upgrade = false;             ///< wants to become a WebSocket
};

/// The server's thread only; must return within 5 ms.
class Gate {
 public:
  /// False: `reply` holds the refusal, or the redirection. True: `session` is who asks; `reply.set_cookie`
  /// may have been set.
  virtual bool admit(const Approach& approach, SessionIndex& session, Reply& reply) = 0;
  /// The connection of this place is closed; another may get it.
  virtual void on_connection_closed(std::uint32_t place) = 0;

 protected:
  ~Gate() = default;
};

}  // namespace flexrf::panel
