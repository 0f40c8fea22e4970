// What the server serves: whom it lets in, what it answers, what it tells without being asked.
#pragma once

#include <cstdint>

#include "base/time.hpp"
#include "web-ui/server/exchange.hpp"
#include "web-ui/server/live_link.hpp"

namespace flexrf::panel {

/// The server's thread only; each call returns within 5 ms.
class Service {
 public:
  /// Whether a request may go on to handle(), or be an upgrade. False: `reply` holds the refusal, or the
  /// redirection. True: `session` is who asks; `reply.set_cookie` may have been set.
  virtual bool admit(const Request& request, SessionIndex& session, Reply& reply) = 0;
  /// The connection of this place is closed; another may get it.
  virtual void on_connection_closed(std::uint32_t place) = 0;

  virtual Handled handle(const Request& request, Reply& reply, Ticket ticket) = 0;

  /// Who talks over live connections; always the same.
  virtual LiveService& live() noexcept = 0;

  /// What is due from time to time: sent, ended, fetched from other threads. When until_next() has passed or
  /// the server's bell was rung, soon after each handled request or message, and at least each 100 ms.
  virtual void on_tick(Time now) = 0;
  /// Until there is something to do; zero: at once, but others first.
  virtual Duration until_next(Time now) const = 0;

 protected:
  ~Service() = default;
};

}  // namespace flexrf::panel
