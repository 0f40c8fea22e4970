// Who asked for something, and must be answered.
#pragma once

#include <cstdint>

#include "web-ui/server/exchange.hpp"

namespace flexrf::panel {

struct Caller {
  enum class Kind : std::uint8_t { nobody, rest, live };

  Kind kind = Kind::nobody;
  SessionIndex session = no_session;
  Ticket ticket{};            ///< rest
  std::uint32_t place = 0;    ///< live: of the connection,
  std::uint32_t opening = 0;  ///< and which of those that had this place
  std::uint64_t id = 0;       ///< live: of the message

  static Caller rest(SessionIndex session, Ticket ticket) noexcept {
    Caller caller;
    caller.kind = Kind::rest;
    caller.session = session;
    caller.ticket = ticket;
    return caller;
  }
};

}  // namespace flexrf::panel
