#include "web-ui/server/connection.hpp"

#include <sys/socket.h>

#include <algorithm>
#include <cstring>
#include <string_view>
#include <utility>

#include "web-ui/server/encryption.hpp"
#include "web-ui/server/http_problem.hpp"
#include "web-ui/server/reply_head.hpp"

namespace flexrf::panel {
namespace {

constexpr std::size_t most_lingered = 1U << 20;  // bytes
/// Of a client that has nothing to say, where another wants its place.
constexpr Duration stay_between_requests = std::chrono::milliseconds{250};
constexpr Duration stay_before_the_first = std::chrono::seconds{1};

std::string numeric_text(const net::ip::address& address) {
  if (address.is_v6() && address.to_v6().is_v4_mapped()) {
    return net::ip::make_address_v4(net::ip::v4_mapped, address.to_v6()).to_string();
  }
  return address.to_string();
}

}  // namespace

Address remote_address_of(const tcp::endpoint& endpoint) {
  return Address::parse(numeric_text(endpoint.address())).value_or(Address{});
}

Connection::Connection(Surroundings& surroundings, std::uint32_t place)
    : surroundings_(surroundings),
      place_(place),
      transport_(surroundings.context),
      memory_(make_ordinary_memory(input_size + panel::body_limit + panel::header_limit)),
      input_(memory_.get()),
      body_(input_ + input_size),
      path_(body_ + panel::body_limit),
      message_rate_(surroundings.settings.live_message_rate) {
  reply_.text.reserve(4U << 10);
  reply_.etag.reserve(80);
  reply_.set_cookie.reserve(200);
  head_.reserve(2U << 10);
}

void Connection::open(Socket socket) {
  error_code error;
  transport_.socket() = std::move(socket);
  const tcp::endpoint remote = transport_.socket().remote_endpoint(error);
  const tcp::endpoint local = transport_.socket().local_endpoint(error);
  transport_.socket().set_option(tcp::no_delay{true}, error);
  transport_.socket().non_blocking(true, error);
  transport_.open(surroundings_.encryption);
  remote_address_ = numeric_text(remote.address());
  const std::optional<Address> remote_end = Address::parse(remote_address_);
  loopback_ = remote_end && remote_end->is_loopback();
  remote_end_ = remote_end.value_or(Address{});
  silent_since_ = surroundings_.now;
  used_ = false;
  turned_away_ = {};
  local_end_ = Address::parse(numeric_text(local.address())).value_or(Address{});
  session_ = no_session;
  input_begin_ = input_end_ = 0;
  keep_alive_ = true;
  lingered_ = 0;
  if (place_ != no_place) ++surroundings_.connections;
  clear_reply(reply_);
  if (error) {
    state_ = State::reading;
    shut();
    return;
  }
  if (!transport_.is_encrypted()) {
    read_request();
    return;
  }
  state_ = State::greeting;
  wait_at_most(surroundings_.settings.header_timeout);
  transport_.async_handshake(under_way([this](error_code failure) {
    if (failure) {
      refuse_encryption(failure);
    } else {
      read_request();
    }
  }));
}

/// Who asked without TLS can be told so, as far as the socket takes it at once.
void Connection::refuse_encryption(const error_code& failure) noexcept {
  if (const char* const why = refusal_of_encryption(failure))
    surroundings_.note_refusal(remote_address_, why);
  const std::string_view answer = answer_without_encryption(failure);
  if (!answer.empty())
    static_cast<void>(::send(transport_.socket().native_handle(), answer.data(), answer.size(),
                             MSG_DONTWAIT | MSG_NOSIGNAL));
  shut();
}

void Connection::turn_away(Socket socket, std::string_view why) {
  open(std::move(socket));
  turned_away_ = why;
}

bool Connection::is_dispensable(Time now) noexcept {
  const bool waits = state_ == State::greeting || (state_ == State::reading && header_end_ == 0);
  if (!waits || now - silent_since_ < (used_ ? stay_between_requests : stay_before_the_first)) return false;
  // What has just come is not to be lost.
  error_code error;
  return transport_.socket().available(error) == 0;
}

void Connection::shut() {
  if (state_ == State::free || state_ == State::shut) return;
  end_live();
  state_ = State::shut;
  ++exchange_;
  transport_.close();
  release_if_idle();
}

void Connection::release_if_idle() {
  if (under_way_ > 0) return;
  web_socket_.reset();
  parser_.reset();
  transport_.reset();
  state_ = State::free;
  if (place_ == no_place) return;
  --surroundings_.connections;
  surroundings_.service.on_connection_closed(place_);
}

void Connection::end() {
  if (state_ == State::live) {
    close(1001, "the application ends");
  } else if (state_ != State::closing) {
    shut();
  }
}

void Connection::check(Time now) {
  if (state_ == State::live) {
    check_live(now);
    return;
  }
  if (state_ == State::free || state_ == State::shut || now < deadline_) return;
  if (state_ == State::reading && input_end_ > 0) {
    refuse_and_end(408, "the request did not come to its end in time");
  } else if (state_ == State::answering) {
    ++exchange_;
    refuse_and_end(504, "the application did not answer in time");
  } else {
    if (state_ == State::replying) transport_.discard();
    shut();
  }
}

// ---- reading

void Connection::read_request() {
  parser_.emplace(body_);
  // The bytes of a next request that came along already.
  std::memmove(input_, input_ + input_begin_, input_end_ - input_begin_);
  input_end_ -= input_begin_;
  input_begin_ = 0;
  header_end_ = 0;
  state_ = State::reading;
  if (input_end_ > 0) {
    wait_at_most(surroundings_.settings.header_timeout);
    parse();
  } else {
    wait_at_most(surroundings_.settings.idle_timeout);
    silent_since_ = surroundings_.now;
    read_more();
  }
}

void Connection::read_more() {
  if (header_end_ > 0) {  // of the body only what is not yet parsed has to stay
    std::memmove(input_ + header_end_, input_ + input_begin_, input_end_ - input_begin_);
    input_end_ -= input_begin_ - header_end_;
    input_begin_ = header_end_;
  }
  if (input_end_ == input_size) {
    refuse_and_end(431, "the header is larger than 8 KiB");
    return;
  }
  input_under_way_ = true;
  transport_.async_read_some(net::buffer(input_ + input_end_, input_size - input_end_),
                             under_way([this](error_code error, std::size_t size) { on_read(error, size); }));
}

void Connection::on_read(error_code error, std::size_t size) {
  input_under_way_ = false;
  if (state_ == State::lingering) {
    lingered_ += size;
    if (error || lingered_ > most_lingered) {
      shut();
    } else {
      input_begin_ = input_end_ = header_end_ = 0;
      read_more();
    }
    return;
  }
  // A request that took too long is being refused meanwhile.
  if (state_ != State::reading) return;
  if (error) {
    shut();
    return;
  }
  if (input_end_ == 0) wait_at_most(surroundings_.settings.header_timeout);
  input_end_ += size;
  parse();
}

void Connection::parse() {
  if (!parser_->got_some()) {
    // Empty lines before a request are to be ignored (RFC 9112, 2.2).
    while (input_begin_ < input_end_ && (input_[input_begin_] == '\r' || input_[input_begin_] == '\n')) {
      ++input_begin_;
    }
    if (input_begin_ == input_end_) {
      read_more();
      return;
    }
  }
  bool header_was_done = false;
  do {
    error_code error;
    header_was_done = parser_->is_header_done();
    input_begin_ += parser_->put(net::const_buffer(input_ + input_begin_, input_end_ - input_begin_), error);
    if (error && error != http::error::need_more) {
      refuse_input(error);
      return;
    }
    if (parser_->is_header_done() && !header_was_done) on_header_done();
  } while (!header_was_done && parser_->is_header_done() && !parser_->is_done() && input_begin_ < input_end_);
  if (parser_->is_done()) {
    handle();
  } else {
    read_more();
  }
}

void Connection::on_header_done() {
  header_end_ = input_begin_;
  parser_->eager(true);
  wait_at_most(surroundings_.settings.body_timeout);
  if (parser_->is_done() || !parser_->header().expects_continue) return;
  // Nothing else is under way, and the few bytes always find room.
  constexpr std::string_view go_on = "HTTP/1.1 100 Continue\r\n\r\n";
  ++under_way_;
  transport_.async_write_some(net::buffer(go_on.data(), go_on.size()),
                              HandlerIn(handler_memory_, [this](error_code, std::size_t) {
                                --under_way_;
                                if (state_ == State::shut) release_if_idle();
                              }));
}

// ---- refusing

void Connection::refuse(unsigned status, std::string_view detail) {
  answer_problem(reply_, status, detail);
  send_reply();
}

void Connection::refuse_and_end(unsigned status, std::string_view detail) {
  keep_alive_ = false;
  clear_reply(reply_);
  refuse(status, detail);
}

void Connection::refuse_input(error_code error) {
  if (error == http::error::header_limit) {
    refuse_and_end(431, "the header is larger than 8 KiB");
  } else if (error == http::error::body_limit) {
    refuse_and_end(413, "the body is larger than 64 KiB");
  } else if (error == http::error::bad_version) {
    refuse_and_end(505, "this server speaks HTTP/1.1");
  } else {
    refuse_and_end(400, "this is no HTTP request");
  }
}

// ---- replying

void Connection::send_reply() {
  state_ = State::replying;
  ReplyHead head;
  head.date = surroundings_.date;
  head.keep_alive = keep_alive_;
  head.extra = std::exchange(extra_head_, {});
  write_reply_head(head_, reply_, head);
  const bool head_only = parser_->is_header_done() && parser_->header().method == Method::head;
  const bool has_body = !head_only && reply_.status != 204 && reply_.status != 304;
  output_ = {std::string_view{head_}, has_body ? body_of(reply_) : std::string_view{}};
  write_more();
}

void Connection::write_more() {
  wait_at_most(surroundings_.settings.write_timeout);
  // What the socket takes at once needs no operation that comes back later. But who has sent the next request
  // along already waits for the others' turn.
  if (!transport_.is_encrypted() && input_begin_ == input_end_) {
    error_code error;
    const std::size_t size = transport_.socket().write_some(output_buffers(), error);
    if (error != net::error::would_block) {
      on_written(error, size);
      return;
    }
  }
  transport_.async_write_some(
      output_buffers(), under_way([this](error_code error, std::size_t size) { on_written(error, size); }));
}

std::array<net::const_buffer, 2> Connection::output_buffers() const noexcept {
  return {net::const_buffer(output_[0].data(), output_[0].size()),
          net::const_buffer(output_[1].data(), output_[1].size())};
}

void Connection::drop_output(std::size_t size) noexcept {
  for (std::string_view& part : output_) {
    const std::size_t dropped = std::min(size, part.size());
    part.remove_prefix(dropped);
    size -= dropped;
  }
}

void Connection::on_written(error_code error, std::size_t size) {
  if (error) {
    shut();
    return;
  }
  drop_output(size);
  if (has_output()) {
    write_more();
  } else if (keep_alive_) {
    clear_reply(reply_);
    read_request();
  } else {
    linger();
  }
}

void Connection::linger() {
  state_ = State::lingering;
  wait_at_most(surroundings_.settings.linger_timeout);
  transport_.finish();
  input_begin_ = input_end_ = header_end_ = 0;
  if (!input_under_way_) read_more();
}

}  // namespace flexrf::panel
