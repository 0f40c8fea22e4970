#include "hal/socket/datagram/linux/linux_datagram_transport.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <vector>

namespace flexrf {

static_assert(sizeof(DatagramPeer::address) >= SocketAddress::capacity);

Status LinuxDatagramTransport::open(std::string_view local, std::string_view remote, DatagramPeer& peer) {
  error_ = {};
  const Result<std::vector<SocketAddress>> own = resolve(local, SOCK_DGRAM, true);
  if (!own) return own.status();
  own_ = own->front();
  peer = {};
  if (!remote.empty()) {
    const Result<std::vector<SocketAddress>> found = resolve(remote, SOCK_DGRAM, false);
    if (!found) return found.status();
    const auto fitting = std::find_if(found->begin(), found->end(), [this](const SocketAddress& one) {
      return one.family() == own_.family();
    });
    if (fitting == found->end()) {
      return Status::error(StatusCode::invalid_argument,
                           "local %.*s and remote %.*s are of different kinds: both are IPv4, IPv6 or unix",
                           static_cast<int>(local.size()), local.data(), static_cast<int>(remote.size()),
                           remote.data());
    }
    peer.address = {};
    std::copy(fitting->bytes.begin(), fitting->bytes.end(), peer.address.begin());
    peer.size = fitting->size;
  }
  socket_ = ::socket(own_.family(), SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (socket_ < 0) {
    return Status::error(StatusCode::unavailable, "%.*s: no socket: %s", static_cast<int>(local.size()),
                         local.data(), std::strerror(errno));
  }
  const Status status = bind_to(socket_, own_, std::string(local));
  bound_ = status.is_ok();
  return status;
}

void LinuxDatagramTransport::shut() noexcept {
  if (socket_ >= 0) ::close(socket_);
  socket_ = -1;
  if (bound_) remove_path(own_);
  bound_ = false;
}

long LinuxDatagramTransport::receive(std::span<std::byte> bytes, DatagramPeer& from) noexcept {
  socklen_t size = static_cast<socklen_t>(from.address.size());
  // MSG_TRUNC: the size that it had, also where it did not fit.
  const ssize_t count = ::recvfrom(socket_, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_TRUNC,
                                   reinterpret_cast<sockaddr*>(from.address.data()), &size);
  from.size = size;
  return count;
}

DatagramTransport::Sent LinuxDatagramTransport::send(const DatagramPeer& to,
                                                     std::span<const std::byte> bytes) noexcept {
  const ssize_t count =
      ::sendto(socket_, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL,
               reinterpret_cast<const sockaddr*>(to.address.data()), static_cast<socklen_t>(to.size));
  if (count >= 0) return Sent::done;
  const int error = errno;
  // Within the machine it is one peer that does not read, and must not hold up the others.
  if ((error == EAGAIN || error == ENOBUFS || error == EINTR) && own_.family() != AF_UNIX) return Sent::later;
  const char* const hint = error == ENETUNREACH || error == EHOSTUNREACH
                               ? "; is the cable in, and the address of this machine's network?"
                           : error == ECONNREFUSED || error == ENOENT
                               ? "; nobody listens there, is the peer on?"
                           : error == EAGAIN ? "; the peer does not read"
                           : error == EPERM  ? "; a firewall of this machine refuses it"
                                             : "";
  error_ =
      Status::error(StatusCode::unavailable, "a datagram was not sent: %s%s", std::strerror(error), hint);
  return Sent::failed;
}

}  // namespace flexrf
