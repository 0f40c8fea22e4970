// StreamSocket: connections by which bytes or lines come and go.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "stream_socket_interface.hpp"

namespace flexrf {

/// One connection. Never 0, and never used again for another while the application runs [stream-socket-1].
using SocketSession = std::uint32_t;

/// Everything: the thread the socket lives in; nothing blocks or allocates.
class StreamSocket : public StreamSocketInterface {
 public:
  using StreamSocketInterface::StreamSocketInterface;

  /// Connections as of this cycle, oldest first; at most `configuration.sessions` [stream-socket-2]. One that
  /// the peer has ended is among them until what came before has been read [stream-socket-3], for a second at
  /// most [stream-socket-11].
  virtual std::span<const SocketSession> sessions() const noexcept = 0;

  /// Sent at the end of the cycle [stream-socket-4]. False, and nothing is sent: the connection is gone, or
  /// its peer does not read and there is no room [stream-socket-5].
  virtual bool write(SocketSession session, std::string_view bytes) noexcept = 0;
  virtual bool write_line(SocketSession session, std::string_view line) noexcept = 0;

  /// The next whole line, without its end [stream-socket-6]; valid until the cycle ends [stream-socket-14].
  /// What is not read waits, and holds up its sender in the end: nothing is lost [stream-socket-7]. With the
  /// queue `lines` connected they go there instead [stream-socket-8].
  virtual std::optional<std::string_view> read_line(SocketSession session) noexcept = 0;
  /// All bytes that wait, for who counts no lines; valid until the cycle ends, unless fewer are
  /// taken [stream-socket-9].
  virtual std::string_view peek(SocketSession session) const noexcept = 0;
  /// The first `count` of them have been read; at most as many as peek() gave [stream-socket-15].
  virtual void take(SocketSession session, std::size_t count) noexcept = 0;

  /// Ends the connection once what was written has been sent [stream-socket-10], after a second at the
  /// latest [stream-socket-12]. What connects, connects anew after its pause [stream-socket-13].
  virtual void close(SocketSession session) noexcept = 0;
};

}  // namespace flexrf
