// One HTTP request, taken apart by Beast without memory of its own.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "web-ui/server/asio.hpp"
#include "web-ui/server/exchange.hpp"
#include "web-ui/server/settings.hpp"

namespace flexrf::panel {

/// What a request's header says, of the fields that anybody here asks for. Views lie in the bytes that were
/// put into the parser, which must stay where they are.
struct RequestHeader {
  Method method = Method::other;
  std::string_view target;
  unsigned version = 0;  ///< 10 or 11
  std::string_view host, origin, cookie, content_type, accept_encoding;
  std::string_view if_match, if_none_match;
  std::string_view upgrade, socket_key, socket_version, socket_protocol;
  unsigned hosts = 0;  ///< how many Host fields there are
  unsigned origins = 0;
  bool has_fetch_site = false;
  bool expects_continue = false;
  bool expects_other = false;  ///< an expectation that nobody here can meet
};

/// For one request. Stops at the header's end, until it is told to be eager.
class RequestParser final : public http::basic_parser<true> {
 public:
  /// The body is copied to `body`, of body_limit bytes.
  explicit RequestParser(char* body);

  const RequestHeader& header() const noexcept { return header_; }
  std::string_view body() const noexcept { return {body_, body_size_}; }

 private:
  using View = boost::beast::string_view;

  void on_request_impl(http::verb method, View name, View target, int version, error_code& error) override;
  void on_response_impl(int, View, int, error_code&) override {}
  void on_field_impl(http::field field, View name, View value, error_code& error) override;
  void on_header_impl(error_code& error) override;
  void on_body_init_impl(const boost::optional<std::uint64_t>&, error_code&) override {}
  std::size_t on_body_impl(View body, error_code& error) override;
  void on_chunk_header_impl(std::uint64_t, View, error_code&) override {}
  std::size_t on_chunk_body_impl(std::uint64_t remaining, View body, error_code& error) override;
  void on_finish_impl(error_code&) override {}

  RequestHeader header_;
  char* body_;
  std::size_t body_size_ = 0;
  bool header_done_ = false;
};

}  // namespace flexrf::panel
