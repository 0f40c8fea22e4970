#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "hal/socket/datagram/interface/datagram_transport.hpp"

namespace flexrf {

/// The other ends are the test, between cycles, from the thread that the socket lives in. A far end is its
/// address's text; the configuration's remote is one of them. What they hear and say is kept in memory that
/// grows: it is for tests.
class MockDatagramTransport final : public DatagramTransport {
 public:
  // The far ends.
  void give(std::string_view from, std::string_view bytes);
  /// All that came to it.
  std::vector<std::string> got(std::string_view end) const;
  /// What is sent to it fails with this; ok: no more.
  void break_off(const Status& cause) noexcept { broken_ = cause; }
  /// Before open(): somebody else has the address.
  void refuse(const Status& cause) noexcept { refusal_ = cause; }

  static DatagramPeer peer_of(std::string_view text) noexcept;

  Status open(std::string_view local, std::string_view remote, DatagramPeer& peer);
  void shut() noexcept {}
  std::uint16_t port() const noexcept { return 0; }
  int descriptor() const noexcept { return -1; }

  long receive(std::span<std::byte> bytes, DatagramPeer& from) noexcept override;
  Sent send(const DatagramPeer& to, std::span<const std::byte> bytes) noexcept override;
  const Status& error() const noexcept override { return broken_; }

 private:
  struct Letter {
    DatagramPeer end;
    std::string bytes;
  };

  std::deque<Letter> coming_;
  std::vector<Letter> gone_;
  Status broken_;
  Status refusal_;
};

}  // namespace flexrf
