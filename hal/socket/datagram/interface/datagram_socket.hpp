// DatagramSocket: datagrams that come and go.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <optional>
#include <span>

#include "datagram_socket_interface.hpp"

namespace flexrf {

/// Whose datagram it is, to answer it; compared, and else for the driver alone.
struct DatagramPeer {
  std::array<std::byte, 112> address{};
  std::size_t size = 0;  ///< bytes of it that are meant; 0: nobody

  bool operator==(const DatagramPeer& other) const noexcept {
    return size == other.size && std::memcmp(address.data(), other.address.data(), size) == 0;
  }
};

struct Datagram {
  std::span<const std::byte> bytes;  ///< valid until the cycle ends [datagram-socket-1]
  DatagramPeer from;
  Time at{};  ///< when it was taken in: the cycle's time
};

/// Everything: the thread the socket lives in; nothing blocks or allocates. Datagrams are lost, doubled and
/// overtaken on their way: what matters needs numbers of its own.
class DatagramSocket : public DatagramSocketInterface {
 public:
  using DatagramSocketInterface::DatagramSocketInterface;

  /// The next datagram that came, oldest first [datagram-socket-2].
  virtual std::optional<Datagram> read() noexcept = 0;

  /// To the peer of the configuration, at the end of the cycle [datagram-socket-3]. False, and nothing is
  /// sent: it is longer than `configuration.size`, `configuration.waiting` wait already, or there is no
  /// peer [datagram-socket-4].
  virtual bool write(std::span<const std::byte> bytes) noexcept = 0;
  /// The same, to whose datagram came [datagram-socket-5].
  virtual bool write_to(const DatagramPeer& peer, std::span<const std::byte> bytes) noexcept = 0;
};

}  // namespace flexrf
