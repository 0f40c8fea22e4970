// What all connections of a server share.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/time.hpp"
#include "web-ui/server/asio.hpp"
#include "web-ui/server/service.hpp"
#include "web-ui/server/settings.hpp"

namespace flexrf::panel {

/// The server's thread.
struct Surroundings {
  net::io_context& context;
  net::ssl::context* encryption;  ///< null: plain
  const ServerSettings& settings;
  Service& service;

  Time now{};          ///< at most 10 ms old
  std::string date{};  ///< for headers
  std::uint32_t connections = 0;
  std::uint64_t slow_calls = 0;
  bool handled = false;  ///< since the last tick: somebody may have something to do

  /// Calls a handler and watches how long it takes.
  template <class Call>
  auto watch(std::string_view what, Call&& call) {
    struct Watch {
      Surroundings& surroundings;
      std::string_view what;
      Time begin = MonotonicClock::now();
      ~Watch() { surroundings.note(what, MonotonicClock::now() - begin); }
    } watch{*this, what};
    handled = true;
    return call();
  }

  /// A client did not get as far as a request.
  void note_refusal(std::string_view address, const char* why) noexcept;

 private:
  void note(std::string_view what, Duration taken) noexcept;
};

}  // namespace flexrf::panel
