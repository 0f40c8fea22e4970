#include "web-ui/server/reply_head.hpp"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <utility>

#include "web-ui/server/http_problem.hpp"

namespace flexrf::panel {
namespace {

void append_number(std::string& text, std::size_t number) {
  char digits[20];
  text.append(digits, std::to_chars(digits, digits + sizeof(digits), number).ptr);
}

/// What stands in a value must not end the line: a client's text could else write header lines.
void append_line(std::string& text, std::string_view name, std::string_view value) {
  if (value.empty()) return;
  text += name;
  const auto begin = static_cast<std::ptrdiff_t>(text.size());
  text += value;
  std::replace_if(
      text.begin() + begin, text.end(),
      [](char character) { return static_cast<unsigned char>(character) < 0x20 || character == 0x7F; }, ' ');
  text += "\r\n";
}

}  // namespace

std::string_view security_headers() noexcept {
  return "Content-Security-Policy: default-src 'none'; script-src 'self'; style-src 'self'; "
         "img-src 'self' blob: data:; connect-src 'self'; font-src 'self'; worker-src 'self'; "
         "manifest-src 'self'; base-uri 'none'; form-action 'self'; frame-ancestors 'none'\r\n"
         "X-Content-Type-Options: nosniff\r\n"
         "Referrer-Policy: no-referrer\r\n"
         "Cross-Origin-Opener-Policy: same-origin\r\n"
         "Cross-Origin-Embedder-Policy: require-corp\r\n"
         "Cross-Origin-Resource-Policy: same-origin\r\n";
}

void write_reply_head(std::string& text, const Reply& reply, const ReplyHead& head) {
  text = "HTTP/1.1 ";
  append_number(text, reply.status);
  text += ' ';
  text += title_of(reply.status);
  text += "\r\n";
  append_line(text, "Date: ", head.date);
  text += security_headers();
  const bool has_body = reply.status >= 200 && reply.status != 204 && reply.status != 304;
  if (has_body) {
    append_line(text, "Content-Type: ", reply.content_type);
    append_line(text, "Content-Encoding: ", reply.content_encoding);
    text += "Content-Length: ";
    append_number(text, body_of(reply).size());
    text += "\r\n";
  }
  append_line(text, "Cache-Control: ", reply.cache_control);
  append_line(text, "ETag: ", reply.etag);
  if (reply.varies_by_encoding) text += "Vary: Accept-Encoding\r\n";
  append_line(text, "Location: ", reply.location);
  append_line(text, "Allow: ", reply.allow);
  append_line(text, "Set-Cookie: ", reply.set_cookie);
  if (reply.retry_after > 0) {
    text += "Retry-After: ";
    append_number(text, reply.retry_after);
    text += "\r\n";
  }
  text += head.extra;
  if (!head.keep_alive) text += "Connection: close\r\n";
  text += "\r\n";
}

std::string_view body_of(const Reply& reply) noexcept {
  return reply.fixed.empty() ? std::string_view{reply.text} : reply.fixed;
}

void clear_reply(Reply& reply) noexcept {
  // What one large reply needed is not kept for ever.
  constexpr std::size_t kept = 256U << 10;
  std::string etag = std::move(reply.etag);
  std::string cookie = std::move(reply.set_cookie);
  std::string text = std::move(reply.text);
  reply = Reply{};
  etag.clear();
  cookie.clear();
  if (text.capacity() > kept) text = std::string{};
  text.clear();
  reply.etag = std::move(etag);
  reply.set_cookie = std::move(cookie);
  reply.text = std::move(text);
}

}  // namespace flexrf::panel
