// The service manager's end of NOTIFY_SOCKET (sd_notify(3)).
#pragma once

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstddef>
#include <string>

#include "runtime/executive/tests/checks.hpp"

namespace flexrf::fixture {

/// Listens under a name that nobody else has.
class NotifyListener {
 public:
  NotifyListener() : socket_(socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    CHECK(bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof(address.sun_family)) == 0);
    socklen_t size = sizeof(address);
    CHECK(getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size) == 0);
    name_ = "@" + std::string(address.sun_path + 1, size - offsetof(sockaddr_un, sun_path) - 1);
  }
  NotifyListener(const NotifyListener&) = delete;
  NotifyListener& operator=(const NotifyListener&) = delete;
  ~NotifyListener() { close(socket_); }

  /// As in NOTIFY_SOCKET.
  const std::string& name() const { return name_; }
  /// Empty: nothing came.
  std::string next() const {
    char text[256];
    const ssize_t size = recv(socket_, text, sizeof(text), 0);
    return size > 0 ? std::string(text, static_cast<std::size_t>(size)) : std::string{};
  }

 private:
  int socket_;
  std::string name_;
};

}  // namespace flexrf::fixture
