// One open WebSocket, as who talks over it sees it, and the other way round; knows nothing of sockets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "web-ui/server/exchange.hpp"

namespace flexrf::panel {

/// At most one message is under way to a client. Most are with the kernel when send() returns; while
/// is_writing() says otherwise, whoever wants to send waits for on_writable(), and then composes what is
/// newest. So a slow client costs one buffer, and delays nobody.
class LiveLink {
 public:
  /// Bytes before a message that others get, too: each link writes its frame's head there.
  static constexpr std::size_t head_room = 16;

  /// Place of the connection, below the number of places: what a handler keeps per client is an array of it.
  virtual std::uint32_t place() const = 0;
  virtual SessionIndex session() const = 0;
  virtual bool is_writing() const = 0;
  /// The buffer of the next message, empty; its memory is kept. Only while !is_writing().
  virtual std::string& buffer() = 0;
  /// Sends what is in the buffer. Only while !is_writing().
  virtual void send(bool binary) = 0;
  /// Sends the binary message that stands behind `head_room` bytes of this memory, which is the caller's
  /// again after the call; the buffer is not touched. Only while !is_writing().
  virtual void send_shared(std::span<char> memory) = 0;
  /// Sends a close frame with this code (RFC 6455) and ends the connection, at once if it does not answer.
  virtual void close(std::uint16_t code, std::string_view reason) = 0;

 protected:
  ~LiveLink() = default;
};

/// Who talks over the live connections. The server's thread only; each call returns within 5 ms.
class LiveService {
 public:
  virtual void on_open(LiveLink& link) = 0;
  /// A whole text message; binary ones are refused by the server.
  virtual void on_text(LiveLink& link, std::string_view text) = 0;
  /// The last message is with the kernel, and was not yet when it was sent.
  virtual void on_writable(LiveLink& link) = 0;
  /// Closed by either side, timed out or lost; the link is gone after the call.
  virtual void on_close(LiveLink& link) = 0;

 protected:
  ~LiveService() = default;
};

}  // namespace flexrf::panel
