#include "hal/socket/address/socket_address.hpp"

#include <netdb.h>
#include <netinet/in.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>

namespace flexrf {
namespace {

Status malformed(std::string_view text, int kind) {
  const char* const scheme = kind == SOCK_STREAM ? "tcp" : "udp";
  return Status::error(
      StatusCode::invalid_argument,
      "\"%.*s\" is no address; write %s:192.168.1.20:5000, %s:[::1]:5000, unix:/path or unix:@name",
      static_cast<int>(text.size()), text.data(), scheme, scheme);
}

const char* path_of(const SocketAddress& address) noexcept {
  if (address.family() != AF_UNIX) return nullptr;
  const char* const path = reinterpret_cast<const sockaddr_un*>(address.bytes.data())->sun_path;
  return path[0] == '\0' ? nullptr : path;
}

Result<std::vector<SocketAddress>> local(std::string_view path, std::string_view text) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  // One byte for the zero that ends a path.
  if (path.size() < 2 || path.size() >= sizeof address.sun_path) {
    return Status::error(StatusCode::invalid_argument, "\"%.*s\": a path has 2 to %zu characters",
                         static_cast<int>(text.size()), text.data(), sizeof address.sun_path - 1);
  }
  std::copy(path.begin(), path.end(), address.sun_path);
  const bool is_name = path.front() == '@';
  if (is_name) address.sun_path[0] = '\0';
  SocketAddress result;
  result.size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + path.size() + (is_name ? 0 : 1));
  std::memcpy(result.bytes.data(), &address, result.size);
  return std::vector<SocketAddress>{result};
}

/// True when nobody listens there any more.
bool is_abandoned(int kind, const SocketAddress& address) noexcept {
  const int probe = ::socket(AF_UNIX, kind | SOCK_CLOEXEC, 0);
  if (probe < 0) return false;
  const bool abandoned = ::connect(probe, address.get(), address.size) != 0 && errno == ECONNREFUSED;
  ::close(probe);
  return abandoned;
}

}  // namespace

Result<std::vector<SocketAddress>> resolve(std::string_view text, int kind, bool listen) {
  if (text.starts_with("unix:/") || text.starts_with("unix:@")) return local(text.substr(5), text);
  if (!text.starts_with(kind == SOCK_STREAM ? "tcp:" : "udp:")) return malformed(text, kind);
  const std::string_view place = text.substr(4);
  const std::size_t colon = place.rfind(':');
  if (colon == std::string_view::npos || colon + 1 == place.size()) return malformed(text, kind);
  std::string host(place.substr(0, colon));
  const std::string port(place.substr(colon + 1));
  const bool bracketed = host.starts_with('[') && host.ends_with(']') && host.size() > 2;
  if (bracketed) host = host.substr(1, host.size() - 2);
  const bool is_number = std::all_of(port.begin(), port.end(), [](char c) { return c >= '0' && c <= '9'; });
  if ((host.find(':') != std::string::npos && !bracketed) || (host.empty() && !listen) || !is_number ||
      port.size() > 5 || std::stoi(port) > 65535 || (!listen && std::stoi(port) == 0)) {
    return malformed(text, kind);
  }
  addrinfo wanted{};
  wanted.ai_socktype = kind;
  wanted.ai_flags = AI_NUMERICSERV | (listen ? AI_PASSIVE : 0);
  addrinfo* found = nullptr;
  const int error = getaddrinfo(host.empty() ? nullptr : host.c_str(), port.c_str(), &wanted, &found);
  if (error != 0) {
    return Status::error(StatusCode::not_found,
                         "\"%s\" is not known: %s; a numeric address needs no name service", host.c_str(),
                         gai_strerror(error));
  }
  std::vector<SocketAddress> addresses;
  for (const addrinfo* one = found; one != nullptr; one = one->ai_next) {
    if (one->ai_addrlen > SocketAddress::capacity) continue;
    SocketAddress address;
    std::memcpy(address.bytes.data(), one->ai_addr, one->ai_addrlen);
    address.size = one->ai_addrlen;
    addresses.push_back(address);
  }
  freeaddrinfo(found);
  return addresses;
}

Status bind_to(int socket, const SocketAddress& address, const std::string& text) {
  int kind = SOCK_STREAM;
  socklen_t size = sizeof kind;
  getsockopt(socket, SOL_SOCKET, SO_TYPE, &kind, &size);
  if (::bind(socket, address.get(), address.size) == 0) return {};
  if (errno == EADDRINUSE && path_of(address) != nullptr && is_abandoned(kind, address)) {
    remove_path(address);
    if (::bind(socket, address.get(), address.size) == 0) return {};
  }
  const int error = errno;
  if (error == EADDRINUSE) {
    return Status::error(StatusCode::busy,
                         "%s is in use: another program listens there (ss -lnp shows which)", text.c_str());
  }
  if (error == EACCES || error == EPERM) {
    return Status::error(StatusCode::not_permitted,
                         "%s: %s; ports below 1024 and others' folders need a right", text.c_str(),
                         std::strerror(error));
  }
  return Status::error(
      StatusCode::unavailable, "%s cannot be bound: %s%s", text.c_str(), std::strerror(error),
      error == EADDRNOTAVAIL ? "; has this machine the address, and is the interface up?" : "");
}

std::uint16_t port_of(int socket) noexcept {
  SocketAddress address;
  address.size = SocketAddress::capacity;
  if (::getsockname(socket, address.get(), &address.size) != 0) return 0;
  if (address.family() == AF_INET) {
    return ntohs(reinterpret_cast<const sockaddr_in*>(address.bytes.data())->sin_port);
  }
  if (address.family() != AF_INET6) return 0;
  return ntohs(reinterpret_cast<const sockaddr_in6*>(address.bytes.data())->sin6_port);
}

void remove_path(const SocketAddress& address) noexcept {
  const char* const path = path_of(address);
  struct stat status {};
  if (path != nullptr && ::lstat(path, &status) == 0 && S_ISSOCK(status.st_mode)) ::unlink(path);
}

}  // namespace flexrf
