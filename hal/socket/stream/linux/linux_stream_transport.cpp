#include "hal/socket/stream/linux/linux_stream_transport.hpp"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

namespace flexrf {
namespace {

constexpr int backlog = 8;

void set(int descriptor, int level, int option, int value) noexcept {
  setsockopt(descriptor, level, option, &value, sizeof value);
}

}  // namespace

Status LinuxStreamTransport::open(std::string_view address, bool listen, Duration peer_timeout) {
  text_ = address;
  peer_timeout_ = peer_timeout;
  next_ = 0;
  error_ = {};
  Result<std::vector<SocketAddress>> found = resolve(address, SOCK_STREAM, listen);
  if (!found) return found.status();
  addresses_ = std::move(*found);
  if (!listen) return {};
  const SocketAddress& own = addresses_.front();
  listener_ = ::socket(own.family(), SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (listener_ < 0) {
    return Status::error(StatusCode::unavailable, "%s: no socket: %s", text_.c_str(), std::strerror(errno));
  }
  // Connections of before that wait out their time are no reason to wait for them.
  set(listener_, SOL_SOCKET, SO_REUSEADDR, 1);
  Status status = bind_to(listener_, own, text_);
  if (status && ::listen(listener_, backlog) != 0) {
    status = Status::error(errno == EADDRINUSE ? StatusCode::busy : StatusCode::unavailable,
                           "%s: nobody can be listened to: %s", text_.c_str(), std::strerror(errno));
  }
  if (!status) {
    ::close(listener_);
    listener_ = -1;
  }
  return status;
}

void LinuxStreamTransport::shut() noexcept {
  for (std::size_t place = 0; place < descriptors_.size(); ++place) close(place);
  if (listener_ < 0) return;
  ::close(listener_);
  listener_ = -1;
  remove_path(addresses_.front());
}

StreamTransport::Attempt LinuxStreamTransport::connect() noexcept {
  const SocketAddress& peer = addresses_[next_];
  descriptors_[0] = ::socket(peer.family(), SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (descriptors_[0] < 0) return fail(errno);
  prepare(descriptors_[0], peer);
  if (::connect(descriptors_[0], peer.get(), peer.size) == 0) return Attempt::done;
  // Within the machine EAGAIN says that the listener's queue is full: that is no attempt under way.
  return errno == EINPROGRESS ? Attempt::pending : fail(errno);
}

StreamTransport::Attempt LinuxStreamTransport::attempt() noexcept {
  pollfd wanted{descriptors_[0], POLLOUT, 0};
  if (::poll(&wanted, 1, 0) <= 0) return Attempt::pending;
  int error = 0;
  socklen_t size = sizeof error;
  if (getsockopt(descriptors_[0], SOL_SOCKET, SO_ERROR, &error, &size) != 0) error = errno;
  return error == 0 ? Attempt::done : fail(error);
}

/// A name may have several addresses: they are tried in turn.
StreamTransport::Attempt LinuxStreamTransport::fail(int error) noexcept {
  const char* const hint = error == ECONNREFUSED || error == ENOENT
                               ? "; nobody listens there, is the peer on?"
                           : error == ENETUNREACH || error == EHOSTUNREACH
                               ? "; is the cable in, and the address of this machine's network?"
                               : "";
  error_ = Status::error(StatusCode::unavailable, "%s: %s%s", text_.c_str(), std::strerror(error), hint);
  next_ = (next_ + 1) % addresses_.size();
  return Attempt::failed;
}

void LinuxStreamTransport::prepare(int descriptor, const SocketAddress& address) const noexcept {
  if (address.family() == AF_UNIX) return;
  const auto whole = std::max<int>(1, static_cast<int>(seconds(peer_timeout_)));
  set(descriptor, IPPROTO_TCP, TCP_NODELAY, 1);
  set(descriptor, SOL_SOCKET, SO_KEEPALIVE, 1);
  set(descriptor, IPPROTO_TCP, TCP_KEEPIDLE, std::max(1, whole / 2));
  set(descriptor, IPPROTO_TCP, TCP_KEEPINTVL, 1);
  set(descriptor, IPPROTO_TCP, TCP_KEEPCNT, std::max(1, whole - whole / 2));
  set(descriptor, IPPROTO_TCP, TCP_USER_TIMEOUT, whole * 1000);
}

bool LinuxStreamTransport::accept(std::size_t place) noexcept {
  const int descriptor = ::accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
  if (descriptor < 0) return false;
  prepare(descriptor, addresses_.front());
  descriptors_[place] = descriptor;
  return true;
}

bool LinuxStreamTransport::turn_away() noexcept {
  const int descriptor = ::accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
  if (descriptor >= 0) ::close(descriptor);
  return descriptor >= 0;
}

long LinuxStreamTransport::receive(std::size_t place, std::span<char> bytes) noexcept {
  const ssize_t count = ::recv(descriptors_[place], bytes.data(), bytes.size(), MSG_DONTWAIT);
  if (count > 0) return count;
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) return 0;
  error_ = count == 0 ? Status{}
                      : Status::error(StatusCode::unavailable, "%s: the connection broke: %s", text_.c_str(),
                                      std::strerror(errno));
  return -1;
}

long LinuxStreamTransport::send(std::size_t place, std::string_view bytes) noexcept {
  const ssize_t count = ::send(descriptors_[place], bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
  if (count >= 0) return count;
  if (errno == EAGAIN || errno == EINTR) return 0;
  // A peer that has closed its end is told by what is received, with all that it sent before.
  if (errno == EPIPE || errno == ECONNRESET) return 0;
  error_ = Status::error(StatusCode::unavailable, "%s: the connection broke: %s", text_.c_str(),
                         std::strerror(errno));
  return -1;
}

void LinuxStreamTransport::close(std::size_t place) noexcept {
  if (descriptors_[place] >= 0) ::close(descriptors_[place]);
  descriptors_[place] = -1;
}

}  // namespace flexrf
