#include "hal/socket/datagram/mock/mock_datagram_transport.hpp"

#include <algorithm>

namespace flexrf {

DatagramPeer MockDatagramTransport::peer_of(std::string_view text) noexcept {
  DatagramPeer peer;
  peer.size = std::min(text.size(), peer.address.size());
  std::memcpy(peer.address.data(), text.data(), peer.size);
  return peer;
}

void MockDatagramTransport::give(std::string_view from, std::string_view bytes) {
  coming_.push_back({peer_of(from), std::string(bytes)});
}

std::vector<std::string> MockDatagramTransport::got(std::string_view end) const {
  std::vector<std::string> all;
  for (const Letter& letter : gone_) {
    if (letter.end == peer_of(end)) all.push_back(letter.bytes);
  }
  return all;
}

Status MockDatagramTransport::open(std::string_view /*local*/, std::string_view remote, DatagramPeer& peer) {
  peer = peer_of(remote);
  return refusal_;
}

long MockDatagramTransport::receive(std::span<std::byte> bytes, DatagramPeer& from) noexcept {
  if (coming_.empty()) return -1;
  const Letter& letter = coming_.front();
  const std::size_t size = letter.bytes.size();
  std::memcpy(bytes.data(), letter.bytes.data(), std::min(size, bytes.size()));
  from = letter.end;
  coming_.pop_front();
  return static_cast<long>(size);
}

DatagramTransport::Sent MockDatagramTransport::send(const DatagramPeer& to,
                                                    std::span<const std::byte> bytes) noexcept {
  if (!broken_.is_ok()) return Sent::failed;
  gone_.push_back({to, std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size())});
  return Sent::done;
}

}  // namespace flexrf
