// The WebSocket half of a connection.
#include <algorithm>

#include "web-ui/server/connection.hpp"
#include "web-ui/server/reply_head.hpp"
#include "web-ui/server/request_target.hpp"

namespace flexrf::panel {
namespace {

constexpr std::string_view protocol = "flexrf.v1";
constexpr std::size_t most_reason = 123;  // bytes, RFC 6455
/// Of the socket; each gives up to 1.5 KB. A page needs some 50 a second.
constexpr std::int64_t most_reads_per_second = 8000;

boost::beast::string_view view_of(std::string_view text) noexcept {
  return {text.data(), text.size()};
}

}  // namespace

// ---- the upgrade

bool Connection::wants_upgrade() const {
  const std::string_view upgrade = parser_->header().upgrade;
  return parser_->upgrade() && boost::beast::iequals(view_of(upgrade), "websocket");
}

void Connection::upgrade() {
  const RequestHeader& header = parser_->header();
  if (header.method != Method::get) {
    reply_.allow = "GET";
    refuse(405, "this path is for WebSockets");
  } else if (!wants_upgrade() || header.version != 11 || header.socket_version != "13") {
    extra_head_ = "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\n";
    refuse(426, "this path is for WebSockets (RFC 6455, version 13)");
  } else if (header.socket_key.size() != 24) {
    refuse(400, "Sec-WebSocket-Key has to be 16 bytes in base64");
  } else if (!list_has(header.socket_protocol, protocol)) {
    refuse(400, "Sec-WebSocket-Protocol has to offer flexrf.v1");
  } else if (!parser_->body().empty() || input_begin_ != input_end_) {
    refuse_and_end(400, "nothing may follow the upgrade before it is answered");
  } else {
    accept_upgrade();
  }
}

void Connection::accept_upgrade() {
  const RequestHeader& header = parser_->header();
  state_ = State::upgrading;
  wait_at_most(surroundings_.settings.header_timeout);
  http::request<http::empty_body> request{http::verb::get, view_of(header.target), 11};
  request.set(http::field::host, view_of(header.host));
  request.set(http::field::connection, "upgrade");
  request.set(http::field::upgrade, "websocket");
  request.set(http::field::sec_websocket_key, view_of(header.socket_key));
  request.set(http::field::sec_websocket_version, "13");
  web_socket_.emplace(transport_);
  web_socket_->set_option(websocket::stream_base::decorator([this](websocket::response_type& response) {
    response.set(http::field::sec_websocket_protocol, view_of(protocol));
    response.set(http::field::server, "FlexRF");
    if (!reply_.set_cookie.empty()) response.set(http::field::set_cookie, reply_.set_cookie);
  }));
  web_socket_->auto_fragment(false);
  web_socket_->read_message_max(live_message_limit);
  // Beast answers pings itself; here they are only counted.
  web_socket_->control_callback([this](websocket::frame_type, boost::beast::string_view) {
    answers_ping_ = true;
    if (!message_rate_.take(surroundings_.now)) flooded_ = true;
  });
  web_socket_->async_accept(request, under_way([this](error_code error) { on_upgraded(error); }));
}

void Connection::on_upgraded(error_code error) {
  if (error) {
    shut();
    return;
  }
  clear_reply(reply_);
  state_ = State::live;
  message_rate_.reset();
  heard_ = reads_checked_ = surroundings_.now;
  transport_.take_reads();
  message_size_ = 0;
  writing_ = answers_ping_ = flooded_ = false;
  announced_ = true;
  {
    const Watch watch(surroundings_, "the opening of a live connection");
    surroundings_.service.live().on_open(*this);
  }
  if (state_ == State::live) read_message();
}

// ---- receiving

void Connection::read_message() {
  // Always room for a byte: Beast finds a message that is too long when there is more of it.
  web_socket_->async_read_some(
      net::buffer(body_ + message_size_, live_message_limit + 1 - message_size_),
      under_way([this](error_code error, std::size_t size) { on_message_part(error, size); }));
}

void Connection::on_message_part(error_code error, std::size_t size) {
  if (state_ != State::live) return;  // its closing is under way and sees to the rest
  if (error) {
    end_live();
    linger();
    return;
  }
  answers_ping_ = false;
  message_size_ += size;
  if (web_socket_->is_message_done()) {
    if (const std::optional<std::string_view> text = take_message()) {
      const Watch watch(surroundings_, "a live message");
      surroundings_.service.live().on_text(*this, *text);
    }
  }
  if (state_ == State::live) read_message();
}

std::optional<std::string_view> Connection::take_message() {
  if (!message_rate_.take(surroundings_.now)) {
    close(1008, "too many messages");
    return std::nullopt;
  }
  if (web_socket_->got_binary()) {
    close(1003, "only text is understood");
    return std::nullopt;
  }
  // Not the turn's time: where the server itself stood still, that is from before, and nobody was silent.
  heard_ = MonotonicClock::now();
  return std::string_view{body_, std::exchange(message_size_, 0U)};
}

// ---- sending

// Beast's way to the socket costs more than the message where the socket takes it at once, as it nearly
// always does. So it is handed over here, where nothing of Beast's can be under way; what the socket does not
// take goes on in the background, and Beast waits for it.

bool Connection::may_send_directly() const {
  return !transport_.is_encrypted() && !answers_ping_ && web_socket_->is_open();
}

void Connection::send(bool binary) {
  if (is_writing()) return;
  if (!may_send_directly()) {
    send_by_beast(binary);
    return;
  }
  char* const end = frame_head_.data() + frame_head_.size();
  const char* const begin = write_frame_head(end, binary, reply_.text.size());
  output_ = {std::string_view{begin, end}, std::string_view{reply_.text}};
  error_code error;
  drop_output(transport_.socket().write_some(output_buffers(), error));
  if (has_output()) {
    begin_rest();
  } else {
    reply_.text.clear();
  }
}

void Connection::send_shared(std::span<char> memory) {
  if (is_writing()) return;
  // Also where all is taken at once: the day on which it is not takes no memory then.
  reply_.text.reserve(memory.size());
  char* const message = memory.data() + head_room;
  const std::size_t size = memory.size() - head_room;
  if (!may_send_directly()) {
    reply_.text.assign(message, size);
    send_by_beast(true);
    return;
  }
  std::string_view frame{write_frame_head(message, true, size), message + size};
  frame.remove_prefix(transport_.send_now(frame));
  if (frame.empty()) return;
  reply_.text.assign(frame);
  output_ = {std::string_view{}, std::string_view{reply_.text}};
  begin_rest();
}

void Connection::begin_rest() {
  writing_ = true;
  write_deadline_ = surroundings_.now + surroundings_.settings.write_timeout;
  transport_.hold_writes();
  send_rest();
}

void Connection::send_rest() {
  transport_.async_send_rest(output_buffers(), under_way([this](error_code error, std::size_t size) {
                               drop_output(size);
                               if (!error && has_output()) {
                                 send_rest();
                                 return;
                               }
                               transport_.release_writes();
                               on_sent(error);
                             }));
}

void Connection::send_by_beast(bool binary) {
  writing_ = true;
  write_deadline_ = surroundings_.now + surroundings_.settings.write_timeout;
  web_socket_->binary(binary);
  web_socket_->async_write(net::buffer(reply_.text),
                           under_way([this](error_code error, std::size_t) { on_sent(error); }));
}

void Connection::on_sent(error_code error) {
  writing_ = false;
  if (state_ != State::live) return;
  if (error) {
    shut();
    return;
  }
  reply_.text.clear();
  const Watch watch(surroundings_, "a live connection that can take more");
  surroundings_.service.live().on_writable(*this);
}

// ---- the end

void Connection::check_live(Time now) {
  const ServerSettings& settings = surroundings_.settings;
  if (writing_ && now > write_deadline_) {
    transport_.discard();
    shut();
    return;
  }
  const Duration span = now - reads_checked_;
  reads_checked_ = now;
  const auto most_reads =
      most_reads_per_second * std::max<std::int64_t>(span.count(), 1) / 1'000'000'000 + 64;
  if (transport_.take_reads() > most_reads) flooded_ = true;
  if (flooded_) {
    close(1008, "too many frames");
  } else if (now - heard_ > settings.live_silence && span <= settings.live_silence / 2) {
    // A server that was kept from its work itself hears first what waits.
    close(1008, "silent for too long");
  }
}

void Connection::close(std::uint16_t code, std::string_view reason) {
  if (state_ != State::live) return;
  state_ = State::closing;
  wait_at_most(surroundings_.settings.linger_timeout);
  websocket::close_reason why;
  why.code = code;
  reason = reason.substr(0, most_reason);
  why.reason.assign(reason.data(), reason.size());
  web_socket_->async_close(why, under_way([this](error_code) { shut(); }));
}

void Connection::end_live() {
  if (!std::exchange(announced_, false)) return;
  const Watch watch(surroundings_, "the end of a live connection");
  surroundings_.service.live().on_close(*this);
}

}  // namespace flexrf::panel
