#include "hal/robot_arm/melfa_mxt/simulator/mxt_server.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace flexrf::melfa {
namespace {

constexpr Duration longest_pause = std::chrono::seconds(1);

int udp_socket() {
  return socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
}

}  // namespace

Result<std::unique_ptr<MxtServer>> MxtServer::open(const ControllerPlan& plan, bool paced,
                                                   const char* address, std::uint16_t port) {
  std::unique_ptr<MxtServer> server{new MxtServer(plan, paced)};
  sockaddr_in own{};
  own.sin_family = AF_INET;
  own.sin_port = htons(port);
  if (inet_pton(AF_INET, address, &own.sin_addr) != 1)
    return Status::error(StatusCode::invalid_argument, "'%s' is no numeric IPv4 address", address);
  server->socket_ = udp_socket();
  server->stranger_ = udp_socket();
  socklen_t length = sizeof(own);
  if (server->socket_ < 0 || server->stranger_ < 0 ||
      bind(server->socket_, reinterpret_cast<const sockaddr*>(&own), sizeof(own)) != 0 ||
      getsockname(server->socket_, reinterpret_cast<sockaddr*>(&own), &length) != 0)
    return Status::error(StatusCode::unavailable, "no UDP socket at %s:%u: %s", address, unsigned{port},
                         std::strerror(errno));
  server->port_ = ntohs(own.sin_port);
  const Status status = server->thread_.begin<MxtServer, &MxtServer::run>("mxt_server", *server);
  if (!status) return status;
  return server;
}

MxtServer::~MxtServer() {
  thread_.end();
  for (const int descriptor : {socket_, stranger_}) {
    if (descriptor >= 0) close(descriptor);
  }
}

void MxtServer::run() {
  pollfd socket{socket_, POLLIN, 0};
  while (thread_.wait(until_due(), {&socket, 1})) {
    if ((socket.revents & POLLIN) != 0) receive();
    send_due();
  }
}

Duration MxtServer::until_due() {
  const std::lock_guard lock(mutex_);
  const MxtDatagram* const first = wire_.first();
  if (first == nullptr) return longest_pause;
  return std::clamp(Duration{first->due - MonotonicClock::now()}, Duration{0}, longest_pause);
}

void MxtServer::receive() {
  std::array<std::uint8_t, packet_bytes + 1> bytes{};
  sockaddr_in sender{};
  socklen_t length = sizeof(sender);
  const ssize_t size =
      recvfrom(socket_, bytes.data(), bytes.size(), 0, reinterpret_cast<sockaddr*>(&sender), &length);
  if (size < 0) return;
  peer_address_ = sender.sin_addr.s_addr;
  peer_port_ = sender.sin_port;
  {
    const std::lock_guard lock(mutex_);
    wire_.arrived(std::span(bytes).first(static_cast<std::size_t>(size)), MonotonicClock::now());
  }
  send_due();
  ++received_;
}

void MxtServer::send_due() {
  sockaddr_in peer{};
  peer.sin_family = AF_INET;
  peer.sin_addr.s_addr = peer_address_;
  peer.sin_port = peer_port_;
  const Time now = MonotonicClock::now();
  const std::lock_guard lock(mutex_);
  for (const MxtDatagram* first = wire_.first(); first != nullptr && first->due <= now;
       first = wire_.first()) {
    sendto(first->by_stranger ? stranger_ : socket_, first->bytes.data(), first->size, MSG_NOSIGNAL,
           reinterpret_cast<const sockaddr*>(&peer), sizeof(peer));
    wire_.pop();
    ++sent_;
  }
}

}  // namespace flexrf::melfa
