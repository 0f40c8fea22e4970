#include "hal/robot_arm/paced/udp_link.hpp"

#include <arpa/inet.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>

namespace flexrf {
namespace {

// In one call at most: a flood of strangers must not hold up a cycle.
constexpr int most_strangers = 32;

}  // namespace

Status UdpLink::open(const char* address, std::uint16_t port, std::uint16_t local_port) {
  close();
  controller_ = {};
  controller_.sin_family = AF_INET;
  controller_.sin_port = htons(port);
  if (inet_pton(AF_INET, address, &controller_.sin_addr) != 1) {
    return Status::error(StatusCode::invalid_argument,
                         "'%s' is no numeric IPv4 address; write it as 192.168.0.20", address);
  }
  socket_ = socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (socket_ < 0 || !ArrivalClock::enable(socket_)) {
    const int error = errno;
    close();
    return Status::error(StatusCode::unavailable, "no UDP socket can be made: %s", std::strerror(error));
  }
  sockaddr_in own{};
  own.sin_family = AF_INET;
  own.sin_port = htons(local_port);
  own.sin_addr.s_addr = htonl(INADDR_ANY);
  if (bind(socket_, reinterpret_cast<const sockaddr*>(&own), sizeof(own)) != 0) {
    const Status status = Status::error(StatusCode::unavailable,
                                        "UDP port %u of this machine cannot be used: %s; does another "
                                        "program have it?",
                                        unsigned{local_port}, std::strerror(errno));
    close();
    return status;
  }
  return {};
}

void UdpLink::close() noexcept {
  if (socket_ >= 0) ::close(socket_);
  socket_ = -1;
}

bool UdpLink::send(std::span<const std::uint8_t> datagram, Time /*now*/) noexcept {
  const auto size = static_cast<ssize_t>(datagram.size());
  return sendto(socket_, datagram.data(), datagram.size(), MSG_DONTWAIT | MSG_NOSIGNAL,
                reinterpret_cast<const sockaddr*>(&controller_), sizeof(controller_)) == size;
}

std::optional<ArrivedDatagram> UdpLink::receive(std::span<std::uint8_t> into, Time now) noexcept {
  arrival_.compare();
  for (int i = 0; i < most_strangers; ++i) {
    sockaddr_in sender{};
    alignas(cmsghdr) std::array<char, ArrivalClock::control_bytes> control;
    iovec part{into.data(), into.size()};
    msghdr header{};
    header.msg_name = &sender;
    header.msg_namelen = sizeof(sender);
    header.msg_iov = &part;
    header.msg_iovlen = 1;
    header.msg_control = control.data();
    header.msg_controllen = control.size();
    const ssize_t size = recvmsg(socket_, &header, MSG_DONTWAIT | MSG_TRUNC);
    if (size < 0) return std::nullopt;
    if (sender.sin_addr.s_addr == controller_.sin_addr.s_addr && sender.sin_port == controller_.sin_port)
      return ArrivedDatagram{static_cast<std::size_t>(size), arrival_.time_of(header, now)};
    ++strangers_;
  }
  return std::nullopt;
}

void UdpLink::wait(Duration longest) noexcept {
  pollfd watched{socket_, POLLIN, 0};
  const timespec time{static_cast<time_t>(longest.count() / 1'000'000'000),
                      static_cast<long>(longest.count() % 1'000'000'000)};
  ppoll(&watched, 1, &time, nullptr);
}

}  // namespace flexrf
