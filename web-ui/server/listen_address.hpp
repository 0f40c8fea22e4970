// Where the panel listens, as `--panel` says it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/status.hpp"
#include "web-ui/server/access/address.hpp"

namespace flexrf::panel {

struct ListenAddress {
  std::string address;     ///< numeric
  std::uint16_t port = 0;  ///< 0: any that is free

  bool is_loopback() const noexcept;
  /// Every address of this machine: 0.0.0.0 or ::.
  bool is_any() const noexcept;
  /// "127.0.0.1:8080", "[::1]:8080".
  std::string text() const;
};

/// "127.0.0.1:8080", "localhost:0", "[::1]:8080", "0.0.0.0:443". Any thread.
Result<ListenAddress> parse_listen_address(std::string_view text);

}  // namespace flexrf::panel
