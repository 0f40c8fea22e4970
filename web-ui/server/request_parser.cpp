#include "web-ui/server/request_parser.hpp"

#include <cstring>

namespace flexrf::panel {
namespace {

Method method_of(http::verb verb) noexcept {
  switch (verb) {
    case http::verb::get:
      return Method::get;
    case http::verb::head:
      return Method::head;
    case http::verb::put:
      return Method::put;
    case http::verb::post:
      return Method::post;
    default:
      return Method::other;
  }
}

}  // namespace

RequestParser::RequestParser(char* body) : body_(body) {
  header_limit(static_cast<std::uint32_t>(panel::header_limit));
  body_limit(panel::body_limit);
}

void RequestParser::on_request_impl(http::verb method, View, View target, int version, error_code&) {
  header_.method = method_of(method);
  header_.target = {target.data(), target.size()};
  header_.version = static_cast<unsigned>(version);
}

void RequestParser::on_field_impl(http::field field, View name, View value, error_code& error) {
  if (header_done_) return;  // of a trailer, which must not change what was decided by the header
  // Where a value is continued on a second line, which RFC 9112 lets us refuse, Beast has joined the lines
  // elsewhere, and the view would soon point to nothing.
  if (!value.empty() && (value.data() < name.data() || value.data() > name.data() + panel::header_limit)) {
    error = http::error::bad_value;
    return;
  }
  const std::string_view text{value.data(), value.size()};
  switch (field) {
    case http::field::host:
      header_.host = text;
      ++header_.hosts;
      break;
    case http::field::origin:
      header_.origin = text;
      ++header_.origins;
      break;
    case http::field::cookie:
      header_.cookie = text;
      break;
    case http::field::content_type:
      header_.content_type = text;
      break;
    case http::field::accept_encoding:
      header_.accept_encoding = text;
      break;
    case http::field::if_match:
      header_.if_match = text;
      break;
    case http::field::if_none_match:
      header_.if_none_match = text;
      break;
    case http::field::upgrade:
      header_.upgrade = text;
      break;
    case http::field::sec_websocket_key:
      header_.socket_key = text;
      break;
    case http::field::sec_websocket_version:
      header_.socket_version = text;
      break;
    case http::field::sec_websocket_protocol:
      header_.socket_protocol = text;
      break;
    case http::field::expect:
      header_.expects_continue = boost::beast::iequals(value, "100-continue");
      header_.expects_other = !header_.expects_continue;
      break;
    default:
      if (boost::beast::iequals(name, "Sec-Fetch-Site")) header_.has_fetch_site = true;
  }
}

void RequestParser::on_header_impl(error_code&) {
  header_done_ = true;
}

std::size_t RequestParser::on_body_impl(View body, error_code& error) {
  if (body.size() > panel::body_limit - body_size_) {
    error = http::error::body_limit;
    return 0;
  }
  std::memcpy(body_ + body_size_, body.data(), body.size());
  body_size_ += body.size();
  return body.size();
}

std::size_t RequestParser::on_chunk_body_impl(std::uint64_t, View body, error_code& error) {
  return on_body_impl(body, error);
}

}  // namespace flexrf::panel
