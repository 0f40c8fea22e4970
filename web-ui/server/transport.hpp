// A connection's stream of bytes, plain or encrypted.
#pragma once

#include <sys/socket.h>

#include <optional>
#include <string_view>
#include <utility>

#include "web-ui/server/asio.hpp"

namespace flexrf::panel {

/// An AsyncReadStream and AsyncWriteStream for Asio and Beast. One type for both, so that all that is built
/// on it is compiled once. The server's thread.
class Transport {
 public:
  using executor_type = Executor;

  explicit Transport(net::io_context& context)
      : socket_(context), released_(context, Timer::time_point::max()) {}

  executor_type get_executor() noexcept { return socket_.get_executor(); }
  Socket& socket() noexcept { return socket_; }
  bool is_encrypted() const noexcept { return encrypted_.has_value(); }

  /// The socket is connected. `encryption` null: plain.
  void open(net::ssl::context* encryption) {
    if (encryption != nullptr) encrypted_.emplace(socket_, *encryption);
  }
  /// What is under way ends with an error; its handlers are still to come.
  void close() noexcept {
    error_code ignored;
    socket_.close(ignored);
    release_writes();
  }
  /// What was not yet taken by the other side is not sent any more, once this is closed.
  void discard() noexcept {
    error_code ignored;
    socket_.set_option(net::socket_base::linger{true, 0}, ignored);
  }
  /// Only when nothing is under way any more.
  void reset() noexcept { encrypted_.reset(); }
  /// Tells the other side that no more will come.
  void finish() noexcept {
    error_code ignored;
    socket_.shutdown(Socket::shutdown_send, ignored);
  }

  template <class Handler>
  void async_handshake(Handler&& handler) {
    encrypted_->async_handshake(net::ssl::stream_base::server, std::forward<Handler>(handler));
  }
  template <class Buffers, class Handler>
  void async_read_some(const Buffers& buffers, Handler&& handler) {
    ++reads_;
    if (encrypted_) {
      encrypted_->async_read_some(buffers, std::forward<Handler>(handler));
    } else {
      socket_.async_read_some(buffers, std::forward<Handler>(handler));
    }
  }
  template <class Buffers, class Handler>
  void async_write_some(const Buffers& buffers, Handler&& handler) {
    if (held_) {
      released_.async_wait(
          Held<Buffers, std::decay_t<Handler>>{*this, buffers, std::forward<Handler>(handler)});
    } else if (encrypted_) {
      encrypted_->async_write_some(buffers, std::forward<Handler>(handler));
    } else {
      socket_.async_write_some(buffers, std::forward<Handler>(handler));
    }
  }

  // ---- past Beast, straight to the socket: of plain connections only

  /// Bytes that the socket takes at once; none where it has failed, too, as the next operation tells.
  std::size_t send_now(std::string_view bytes) noexcept {
    const ssize_t sent =
        ::send(socket_.native_handle(), bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    return sent > 0 ? static_cast<std::size_t>(sent) : 0;
  }
  /// Whoever writes from now on waits: half a message is out, and its rest goes by async_send_rest().
  void hold_writes() noexcept { held_ = true; }
  void release_writes() noexcept {
    if (std::exchange(held_, false)) released_.cancel();
  }
  template <class Buffers, class Handler>
  void async_send_rest(const Buffers& buffers, Handler&& handler) {
    socket_.async_write_some(buffers, std::forward<Handler>(handler));
  }

  /// Reads since the last call: how busy the other side keeps us, whatever it sends.
  std::uint32_t take_reads() noexcept { return std::exchange(reads_, 0U); }

 private:
  /// A write that waits for its turn.
  template <class Buffers, class Handler>
  struct Held {
    using allocator_type = net::associated_allocator_t<Handler>;
    allocator_type get_allocator() const noexcept { return net::get_associated_allocator(handler); }
    void operator()(error_code) { transport.async_write_some(buffers, std::move(handler)); }

    Transport& transport;
    Buffers buffers;
    Handler handler;
  };

  Socket socket_;
  std::optional<net::ssl::stream<Socket&>> encrypted_;
  Timer released_;  // never expires; to cancel it is to wake who waits
  bool held_ = false;
  std::uint32_t reads_ = 0;
};

// ---- what Beast's WebSocket wants to know of a stream of ours

inline void beast_close_socket(Transport& transport) {
  transport.close();
}

/// After the closing handshake: the connection waits for the other side's end itself.
template <class Handler>
void async_teardown(boost::beast::role_type, Transport& transport, Handler&& handler) {
  transport.finish();
  net::post(transport.get_executor(),
            [done = std::forward<Handler>(handler)]() mutable { done(error_code{}); });
}

}  // namespace flexrf::panel
