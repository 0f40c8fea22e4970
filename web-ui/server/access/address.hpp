// A numeric network address, whichever way it is written.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace flexrf::panel {

/// IPv4 or IPv6; an IPv4 address is the same written "192.168.0.7" or "::ffff:192.168.0.7". A zone ("%eth0")
/// is left out. Any thread.
class Address {
 public:
  static std::optional<Address> parse(std::string_view text) noexcept;

  bool is_version_4() const noexcept;
  bool is_loopback() const noexcept;  ///< 127.0.0.0/8, ::1
  /// What one party can choose from: an IPv6 network of 64 bits, or the one IPv4 address.
  Address neighbourhood() const noexcept;
  /// "192.168.0.7", "fe80::1".
  std::string text() const;

  bool operator==(const Address&) const noexcept = default;

 private:
  std::array<std::uint8_t, 16> bytes_{};  // IPv4 as mapped into IPv6
};

}  // namespace flexrf::panel
