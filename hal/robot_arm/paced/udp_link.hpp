// UdpLink: datagrams to and from one controller over UDP and IPv4.
#pragma once

#include <netinet/in.h>

#include "base/status.hpp"
#include "hal/driver/arrival_clock.hpp"
#include "hal/robot_arm/paced/datagram_link.hpp"

namespace flexrf {

/// open() and close(): the lifecycle thread. What other senders sent is dropped and counted.
class UdpLink final : public DatagramLink {
 public:
  UdpLink() = default;
  UdpLink(const UdpLink&) = delete;
  UdpLink& operator=(const UdpLink&) = delete;
  ~UdpLink() override { close(); }

  /// `address`: numeric, as 192.168.0.20. `local_port` 0: any. Error: why it cannot, and what to do.
  Status open(const char* address, std::uint16_t port, std::uint16_t local_port);
  void close() noexcept;
  /// Readable when something arrived; −1 while it is not open.
  int descriptor() const noexcept { return socket_; }

  bool send(std::span<const std::uint8_t> datagram, Time now) noexcept override;
  std::optional<ArrivedDatagram> receive(std::span<std::uint8_t> into, Time now) noexcept override;
  std::uint64_t strangers() const noexcept override { return strangers_; }
  void wait(Duration longest) noexcept override;

 private:
  int socket_ = -1;
  sockaddr_in controller_{};
  std::uint64_t strangers_ = 0;
  ArrivalClock arrival_;
};

}  // namespace flexrf
