#include "hal/force_torque/net_ft/simulator/net_ft_server.hpp"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace flexrf {
namespace {

constexpr Duration shortest_pause = std::chrono::milliseconds(1);
constexpr Duration longest_pause = std::chrono::seconds(1);

}  // namespace

Status NetFtServer::plug(std::uint16_t port) {
  unplug();
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(port != 0 ? port : port_);
  socklen_t size = sizeof(address);
  socket_ = ::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  other_ = ::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (socket_ < 0 || other_ < 0 ||
      bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0 ||
      getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size) != 0) {
    const int error = errno;
    unplug();
    return Status::error(StatusCode::unavailable, "no UDP port for the simulator: %s", std::strerror(error));
  }
  port_ = ntohs(address.sin_port);
  client_ = {};
  model_.switch_off_and_on();
  return thread_.begin<NetFtServer, &NetFtServer::run>("net_ft_server", *this);
}

void NetFtServer::unplug() {
  thread_.end();
  for (int* descriptor : {&socket_, &other_}) {
    if (*descriptor >= 0) close(*descriptor);
    *descriptor = -1;
  }
}

void NetFtServer::run() {
  pollfd socket{socket_, POLLIN, 0};
  do {
    receive();
  } while (thread_.wait(send(), {&socket, 1}));
}

void NetFtServer::receive() {
  std::array<std::uint8_t, 64> bytes{};
  sockaddr_in from{};
  while (true) {
    socklen_t size = sizeof(from);
    const ssize_t count =
        recvfrom(socket_, bytes.data(), bytes.size(), 0, reinterpret_cast<sockaddr*>(&from), &size);
    if (count < 0) return;
    client_ = from;
    const std::lock_guard lock(mutex_);
    model_.receive(std::span(bytes).first(static_cast<std::size_t>(count)), MonotonicClock::now());
  }
}

Duration NetFtServer::send() {
  const Time now = MonotonicClock::now();
  const std::lock_guard lock(mutex_);
  while (const auto datagram = model_.send(now)) {
    static_cast<void>(!sendto(datagram->foreign ? other_ : socket_, datagram->bytes.data(), datagram->size, 0,
                              reinterpret_cast<const sockaddr*>(&client_), sizeof(client_)));
  }
  if (model_.next() == Time::max()) return longest_pause;
  return std::clamp(Duration{model_.next() - now}, shortest_pause, longest_pause);
}

}  // namespace flexrf
