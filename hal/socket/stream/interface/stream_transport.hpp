// StreamTransport: what carries the bytes for a driver of StreamSocket.
#pragma once

#include <span>
#include <string_view>

#include "base/status.hpp"

namespace flexrf {

/// Nothing blocks or allocates. Connections lie in places, counted from 0; of what connects there is one.
class StreamTransport {
 public:
  enum class Attempt : std::uint8_t { pending, done, failed };

  virtual ~StreamTransport() = default;

  /// Begins to connect place 0.
  virtual Attempt connect() noexcept = 0;
  /// What came of it.
  virtual Attempt attempt() noexcept = 0;
  /// A peer that waits gets this place; false: none waits.
  virtual bool accept(std::size_t place) noexcept = 0;
  /// A peer that waits is sent away; false: none waits.
  virtual bool turn_away() noexcept = 0;
  /// Bytes that came: their number; 0: none now; −1: the peer has ended, or error() says what broke.
  virtual long receive(std::size_t place, std::span<char> bytes) noexcept = 0;
  /// Bytes that were taken: 0: none now; −1: error() says what broke.
  virtual long send(std::size_t place, std::string_view bytes) noexcept = 0;
  virtual void close(std::size_t place) noexcept = 0;
  /// Of the last attempt or −1; ok: the peer has ended.
  virtual const Status& error() const noexcept = 0;
};

}  // namespace flexrf
