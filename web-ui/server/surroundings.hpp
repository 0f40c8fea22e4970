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

  /// A client did not get as far as a request.
  void note_refusal(std::string_view address, const char* why) noexcept;
};

/// Lives as long as a call of a handler, and notes one that keeps the server for too long.
class Watch {
 public:
  /// `what`: is called; for the log.
  Watch(Surroundings& surroundings, std::string_view what) noexcept
      : surroundings_(surroundings), what_(what) {
    surroundings.handled = true;
  }
  ~Watch();
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

 private:
  Surroundings& surroundings_;
  std::string_view what_;
  Time begin_ = MonotonicClock::now();
};

}  // namespace flexrf::panel
