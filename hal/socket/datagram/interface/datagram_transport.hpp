// DatagramTransport: what carries the datagrams for a driver of DatagramSocket.
#pragma once

#include <span>

#include "hal/socket/datagram/interface/datagram_socket.hpp"

namespace flexrf {

/// Nothing blocks or allocates.
class DatagramTransport {
 public:
  enum class Sent : std::uint8_t { done, later, failed };

  virtual ~DatagramTransport() = default;

  /// The next datagram that came: its size, which is larger than `bytes` if it did not fit; −1: none.
  virtual long receive(std::span<std::byte> bytes, DatagramPeer& from) noexcept = 0;
  /// `failed`: error() says why.
  virtual Sent send(const DatagramPeer& to, std::span<const std::byte> bytes) noexcept = 0;
  virtual const Status& error() const noexcept = 0;
};

}  // namespace flexrf
