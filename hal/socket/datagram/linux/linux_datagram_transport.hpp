#pragma once

#include <string>

#include "hal/socket/address/socket_address.hpp"
#include "hal/socket/datagram/interface/datagram_transport.hpp"

namespace flexrf {

/// One system call for each datagram, and one more in a cycle to see that no more have come.
class LinuxDatagramTransport final : public DatagramTransport {
 public:
  ~LinuxDatagramTransport() override { shut(); }

  /// Lifecycle thread; looks the addresses up. An empty `remote` is no peer.
  Status open(std::string_view local, std::string_view remote, DatagramPeer& peer);
  void shut() noexcept;
  std::uint16_t port() const noexcept { return port_of(socket_); }
  int descriptor() const noexcept { return socket_; }

  long receive(std::span<std::byte> bytes, DatagramPeer& from) noexcept override;
  Sent send(const DatagramPeer& to, std::span<const std::byte> bytes) noexcept override;
  const Status& error() const noexcept override { return error_; }

 private:
  int socket_ = -1;
  bool bound_ = false;
  SocketAddress own_;
  Status error_;
};

}  // namespace flexrf
