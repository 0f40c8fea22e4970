// One place for a client: HTTP requests one after the other, or, after an upgrade, a WebSocket.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "web-ui/server/access/address.hpp"
#include "web-ui/server/asio.hpp"
#include "web-ui/server/frame_head.hpp"
#include "web-ui/server/handler_memory.hpp"
#include "web-ui/server/ordinary_memory.hpp"
#include "web-ui/server/rate_limit.hpp"
#include "web-ui/server/request_parser.hpp"
#include "web-ui/server/request_target.hpp"
#include "web-ui/server/surroundings.hpp"
#include "web-ui/server/transport.hpp"

namespace flexrf::panel {

/// Of a connection that has none: it only tells its clients that there is no room.
inline constexpr std::uint32_t no_place = 0xFFFFFFFF;

/// Numeric; an IPv4 address that is mapped into IPv6 is the IPv4 address.
Address remote_address_of(const tcp::endpoint& endpoint);

/// Lives as long as the server, and is used again for client after client; all its memory is its own. The
/// server's thread.
class Connection final : public LiveLink {
 public:
  Connection(Surroundings& surroundings, std::uint32_t place);
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  bool is_free() const noexcept { return state_ == State::free; }
  /// Its buffers take no memory until a client comes. While it is free.
  void unlock_memory() noexcept { unlock(memory_); }
  void open(Socket socket);
  /// Hears the first request and answers 503 with this reason, which lives for ever.
  void turn_away(Socket socket, std::string_view why);
  /// It waits for a request, or for the rest of one's header, and has been silent for long enough: 250 ms
  /// between two requests, where a browser sends the next one anew on another connection; 1 s before the
  /// first, which it does not.
  bool is_dispensable(Time now) noexcept;
  /// It has had a request.
  bool is_used() const noexcept { return used_; }
  Time silent_since() const noexcept { return silent_since_; }
  /// Its end is under way.
  bool is_leaving() const noexcept { return state_ == State::shut; }
  const Address& remote_end() const noexcept { return remote_end_; }
  /// Ends what has taken too long.
  void check(Time now);
  /// The server ends: a live client is told, others are cut.
  void end();
  /// Cuts the connection; the place is free when all that was under way has come back.
  void shut();

  /// Of a reply that comes later; null: it is not waited for any more.
  Reply* reply_of(std::uint32_t exchange) noexcept;
  void complete(std::uint32_t exchange);

  // ---- LiveLink
  std::uint32_t place() const override { return place_; }
  SessionIndex session() const override { return session_; }
  bool is_writing() const override { return writing_ || state_ != State::live; }
  std::string& buffer() override { return reply_.text; }
  void send(bool binary) override;
  void send_shared(std::span<char> memory) override;
  void close(std::uint16_t code, std::string_view reason) override;

 private:
  enum class State : std::uint8_t {
    free,
    greeting,   // TLS
    reading,    // a request
    answering,  // waits for a handler that answers later
    replying,
    upgrading,
    live,
    closing,    // of a WebSocket
    lingering,  // all is said; waits for the other side's end, so that it gets to read what was said
    shut,       // waits for what is under way to come back
  };

  static constexpr std::size_t input_size = panel::header_limit + (4U << 10);

  /// A handler whose operation lives in this connection's memory, counted while it is under way.
  template <class Function>
  auto under_way(Function function);
  void release_if_idle();
  void wait_at_most(Duration duration) noexcept { deadline_ = surroundings_.now + duration; }

  // ---- connection.cpp: HTTP
  void refuse_encryption(const error_code& failure) noexcept;
  void read_request();
  void read_more();
  void on_read(error_code error, std::size_t size);
  void parse();
  void on_header_done();
  void refuse(unsigned status, std::string_view detail);
  void refuse_input(error_code error);
  void refuse_and_end(unsigned status, std::string_view detail);
  void send_reply();
  void write_more();
  std::array<net::const_buffer, 2> output_buffers() const noexcept;
  void drop_output(std::size_t size) noexcept;
  bool has_output() const noexcept { return !output_[0].empty() || !output_[1].empty(); }
  void on_written(error_code error, std::size_t size);
  void linger();

  // ---- connection_requests.cpp
  void handle();
  unsigned fault_of_header(std::string_view& detail) const;
  void turn_away_request();
  Request request_for(const RequestTarget& target) const;
  bool admit(Request& request);
  void serve(const Request& request);

  // ---- live_connection.cpp: WebSocket
  bool wants_upgrade() const;
  void upgrade();
  void accept_upgrade();
  void on_upgraded(error_code error);
  void read_message();
  void on_message_part(error_code error, std::size_t size);
  /// The message that is complete; none: it was refused.
  std::optional<std::string_view> take_message();
  bool may_send_directly() const;
  void send_by_beast(bool binary);
  void begin_rest();
  void send_rest();
  void on_sent(error_code error);
  void check_live(Time now);
  void end_live();

  Surroundings& surroundings_;
  const std::uint32_t place_;
  HandlerMemory handler_memory_;
  std::uint32_t under_way_ = 0;
  State state_ = State::free;
  Transport transport_;
  Time deadline_{};  // of the state

  // ---- the client
  std::string remote_address_;
  bool loopback_ = false;
  Address remote_end_;
  Time silent_since_{};
  bool used_ = false;
  std::string_view turned_away_;  // why; empty: it is not
  Address local_end_;
  SessionIndex session_ = no_session;

  // ---- the request
  OrdinaryMemory memory_;  // input, body, decoded path
  char* input_;
  char* body_;
  char* path_;
  std::size_t input_begin_ = 0;  // what is parsed next
  std::size_t input_end_ = 0;
  std::size_t header_end_ = 0;  // what stands before it stays until the reply is complete; 0: not yet known
  bool input_under_way_ = false;
  std::optional<RequestParser> parser_;
  std::uint32_t exchange_ = 0;
  bool handler_runs_ = false;
  bool completed_ = false;  // while the handler runs
  bool keep_alive_ = true;

  // ---- the reply
  Reply reply_;
  std::string head_;
  std::string_view extra_head_;
  std::array<std::string_view, 2> output_;  // what is not written yet
  std::size_t lingered_ = 0;                // bytes read while lingering

  // ---- the WebSocket
  using WebSocket = boost::beast::websocket::stream<Transport&, false>;
  std::optional<WebSocket> web_socket_;
  RateLimit message_rate_;
  Time heard_{};
  Time write_deadline_{};
  Time reads_checked_{};
  std::size_t message_size_ = 0;  // in body_
  std::array<char, longest_frame_head> frame_head_{};
  bool writing_ = false;
  bool answers_ping_ = false;  // Beast may be writing, until it comes back with a part of a message
  bool flooded_ = false;
  bool announced_ = false;  // the handler knows of it
};

}  // namespace flexrf::panel

#include "web-ui/server/connection_inline.hpp"
