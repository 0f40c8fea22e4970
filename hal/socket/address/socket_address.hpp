#pragma once

#include <sys/socket.h>
#include <sys/un.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "base/status.hpp"

namespace flexrf {

/// Where a socket is: an address of IPv4, IPv6 or within the machine.
struct SocketAddress {
  static constexpr std::size_t capacity = sizeof(sockaddr_un);
  alignas(sockaddr_storage) std::array<std::byte, capacity> bytes{};
  socklen_t size = 0;

  sockaddr* get() noexcept { return reinterpret_cast<sockaddr*>(bytes.data()); }
  const sockaddr* get() const noexcept { return reinterpret_cast<const sockaddr*>(bytes.data()); }
  int family() const noexcept { return get()->sa_family; }
  bool operator==(const SocketAddress& other) const noexcept {
    return size == other.size && std::memcmp(bytes.data(), other.bytes.data(), size) == 0;
  }
};

/// `tcp:192.168.1.20:5000`, `tcp:[::1]:5000`, `udp:...`, `unix:/path`, `unix:@name`: the addresses that are
/// meant, in the order in which they are to be tried. `kind`: SOCK_STREAM goes with tcp, SOCK_DGRAM with udp.
/// Looks names up, which may take seconds: lifecycle thread. `listen`: an empty host is every address.
Result<std::vector<SocketAddress>> resolve(std::string_view text, int kind, bool listen);

/// Binds and reports what is in the way with a hint. A path whose owner is gone is taken over.
Status bind_to(int socket, const SocketAddress& address, const std::string& text);
/// Its TCP or UDP port, 0 of others.
std::uint16_t port_of(int socket) noexcept;
/// Removes the path of an address of this machine that is one.
void remove_path(const SocketAddress& address) noexcept;

}  // namespace flexrf
