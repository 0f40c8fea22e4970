#pragma once

#include <array>
#include <string>
#include <vector>

#include "hal/socket/address/socket_address.hpp"
#include "hal/socket/stream/interface/stream_links.hpp"

namespace flexrf {

/// System calls in a cycle: one for each connection that has nothing to tell, one more for each piece that
/// comes or goes, one where it listens.
class LinuxStreamTransport final : public StreamTransport {
 public:
  LinuxStreamTransport() { descriptors_.fill(-1); }
  ~LinuxStreamTransport() override { shut(); }

  /// Lifecycle thread; looks the address up, and listens there if that is asked for.
  Status open(std::string_view address, bool listen, Duration peer_timeout);
  void shut() noexcept;
  /// Where it listens.
  std::uint16_t port() const noexcept { return listener_ < 0 ? std::uint16_t{0} : port_of(listener_); }

  Attempt connect() noexcept override;
  Attempt attempt() noexcept override;
  bool accept(std::size_t place) noexcept override;
  bool turn_away() noexcept override;
  long receive(std::size_t place, std::span<char> bytes) noexcept override;
  long send(std::size_t place, std::string_view bytes) noexcept override;
  void close(std::size_t place) noexcept override;
  const Status& error() const noexcept override { return error_; }

 private:
  Attempt fail(int error) noexcept;
  void prepare(int descriptor, const SocketAddress& address) const noexcept;

  std::string text_;
  std::vector<SocketAddress> addresses_;
  std::size_t next_ = 0;  // address that is tried
  Duration peer_timeout_{};
  int listener_ = -1;
  std::array<int, StreamLinks::most_sessions> descriptors_{};
  Status error_;
};

}  // namespace flexrf
