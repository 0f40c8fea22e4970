// Between a driver and a controller that it talks to by datagrams: a socket, or a model in the same process.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "base/time.hpp"

namespace flexrf {

/// What came: its whole length in bytes, and when it arrived, at most now.
struct ArrivedDatagram {
  std::size_t size = 0;
  Time at{};
};

/// The thread of the device, but for wait(): the lifecycle thread. Nothing else blocks or allocates.
class DatagramLink {
 public:
  virtual ~DatagramLink() = default;

  /// False: it did not go out, and nobody tries again.
  virtual bool send(std::span<const std::uint8_t> datagram, Time now) noexcept = 0;
  /// The next one that came from the controller: of a longer one than `into` the rest is gone. Nothing: no
  /// more are there.
  virtual std::optional<ArrivedDatagram> receive(std::span<std::uint8_t> into, Time now) noexcept = 0;
  /// Dropped so far because somebody else sent them.
  virtual std::uint64_t strangers() const noexcept = 0;
  /// Until something is there to receive, or the time is over.
  virtual void wait(Duration /*longest*/) noexcept {}
};

}  // namespace flexrf
