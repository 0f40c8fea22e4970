// What a stranger sends to the panel, up to where its session would be looked for: HTTP in pieces of any
// size, the fields that decide who may come in, and the JSON of a body.
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include "runtime/json/json_reader.hpp"
#include "tests/fuzz/fuzz_target.hpp"
#include "web-ui/server/access/cookie.hpp"
#include "web-ui/server/access/host_rules.hpp"
#include "web-ui/server/access/login_body.hpp"
#include "web-ui/server/request_parser.hpp"
#include "web-ui/server/request_target.hpp"

namespace flexrf::fuzz {
namespace {

using namespace panel;

bool lies_in(std::string_view part, std::string_view whole) {
  return part.empty() ||
         (part.data() >= whole.data() && part.data() + part.size() <= whole.data() + whole.size());
}

/// What is left of a request, whichever way it came.
struct Reading {
  bool done = false;
  std::string target, host, origin, cookie, encodings, tags, body;

  bool operator==(const Reading&) const = default;
};

/// As a connection reads: what is not yet understood is offered again with what comes next.
Reading read_in_pieces(std::string_view bytes, std::size_t piece) {
  // A copy of its own, at whose end the sanitizer watches.
  const std::unique_ptr<char[]> input(new char[bytes.size()]);
  std::copy(bytes.begin(), bytes.end(), input.get());
  const std::unique_ptr<char[]> body(new char[body_limit]);
  RequestParser parser(body.get());
  std::size_t begin = 0, end = 0;
  while (!parser.is_done() && end < bytes.size()) {
    end = std::min(end + piece, bytes.size());
    for (;;) {
      const bool header_was_done = parser.is_header_done();
      error_code error;
      begin += parser.put(net::const_buffer(input.get() + begin, end - begin), error);
      expect(begin <= end);
      if (error && error != http::error::need_more) return {};
      if (header_was_done || !parser.is_header_done()) break;
      parser.eager(true);
      if (parser.is_done() || begin == end) break;
    }
  }
  if (!parser.is_done()) return {};
  const RequestHeader& header = parser.header();
  const std::string_view whole(input.get(), bytes.size());
  for (const std::string_view part :
       {header.target, header.host, header.origin, header.cookie, header.content_type, header.accept_encoding,
        header.if_match, header.if_none_match, header.upgrade, header.socket_key, header.socket_version,
        header.socket_protocol})
    expect(lies_in(part, whole));
  expect(parser.body().size() <= body_limit);
  const auto text = [](std::string_view part) { return std::string(part); };
  return {true,
          text(header.target),
          text(header.host),
          text(header.origin),
          text(header.cookie),
          text(header.accept_encoding),
          text(header.if_none_match),
          text(parser.body())};
}

void judge_target(const std::string& target) {
  const std::unique_ptr<char[]> memory(new char[target.size()]);
  const std::optional<RequestTarget> decoded = decode_target(target, memory.get());
  if (!decoded) return;
  expect(decoded->path.starts_with('/') && lies_in(decoded->path, {memory.get(), target.size()}));
  expect(decoded->path.find("/../") == std::string_view::npos && !decoded->path.ends_with("/.."));
  expect(std::all_of(decoded->path.begin(), decoded->path.end(),
                     [](char one) { return static_cast<unsigned char>(one) >= 0x20 && one != '\\'; }));
}

void judge_origin(const Reading& request) {
  static const HostRules rules(false, {"cell7"});
  const Address here = *Address::parse("192.168.0.7");
  if (rules.allows_host(request.host, here)) {
    const std::string_view host = request.host;
    const std::string_view name =
        host.starts_with('[') ? host.substr(0, host.find(']')) : host.substr(0, host.find(':'));
    std::string lower(name);
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](char one) { return one >= 'A' && one <= 'Z' ? static_cast<char>(one + 32) : one; });
    expect(lower == "localhost" || lower == "cell7" ||
           Address::parse(lower.starts_with('[') ? lower.substr(1) : lower) == here);
  }
  if (rules.allows_origin(request.origin, request.host))
    expect(request.origin.empty() || request.origin.starts_with("http://"));
}

void judge_fields(const Reading& request) {
  CookieValues values(request.cookie, "flexrf_session_8080");
  std::size_t count = 0;
  for (std::string_view value = values.next(); value.data() != nullptr; value = values.next()) {
    expect(lies_in(value, request.cookie));
    expect(++count <= request.cookie.size());
  }
  static_cast<void>(accepts_gzip(request.encodings));
  static_cast<void>(names_tag(request.tags, "\"tag\""));
}

void walk(JsonObject object, std::size_t depth);

void walk(JsonElement value, std::size_t depth) {
  expect(depth <= JsonReader::max_depth);
  if (value.is_double()) expect(std::isfinite(value.get_double().value()));
  if (value.is_array()) {
    const JsonArray array = value.get_array();
    for (const JsonElement element : array) walk(element, depth + 1);
  }
  if (value.is_object()) walk(value.get_object().value(), depth);
}

void walk(JsonObject object, std::size_t depth) {
  expect(object.size() <= JsonReader::max_members);
  for (const auto& [name, member] : object) walk(member, depth + 1);
}

void judge_body(const std::string& body) {
  static JsonReader reader;
  const Result<JsonObject> object = reader.object(body);
  if (object) walk(*object, 1);
  // Two readers of the same bytes are of one mind.
  LoginBody login;
  if (!read_login_body(body, login)) return;
  expect(object.status().is_ok());
  Fields fields(*object);
  expect(fields.text("user") == login.user && fields.text("password") == login.password);
}

}  // namespace

std::vector<Bytes> seeds() {
  return {
      bytes_of("\x05GET /api/v1/slots/tool%20pose?width=3 HTTP/1.1\r\nHost: cell7:8080\r\nCookie: a=b; "
               "flexrf_session_8080=secret\r\nAccept-Encoding: br, gzip;q=0.5\r\nIf-None-Match: "
               "W/\"tag\"\r\n\r\n"),
      bytes_of("\x40PUT /api/v1/components/jog/parameters HTTP/1.1\r\nHost: 192.168.0.7\r\nOrigin: "
               "http://192.168.0.7\r\nContent-Type: application/json\r\nContent-Length: 36\r\n\r\n"
               "{\"speed\":[1,2.5e3,{\"a\":null}],\"b\":1}"),
      bytes_of("\x10POST /api/v1/login HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n"
               "10\r\n{\"user\":\"\\u00e4\",\r\n11\r\n\"password\":\"12\\n\"}\r\n0\r\nHost: other\r\n\r\n"),
      bytes_of("\x01GET /%2e%2e/ HTTP/1.0\r\nhost: [::1]:80\r\nUpgrade: websocket\r\nSec-WebSocket-Key: "
               "x\r\n\r\n")};
}

void take(std::span<const std::uint8_t> bytes) {
  Source source(bytes);
  const std::size_t piece = std::size_t{source.byte()} + 1;
  const auto all = source.some(bytes.size());
  const std::string_view text(reinterpret_cast<const char*>(all.data()), all.size());
  const Reading whole = read_in_pieces(text, std::max<std::size_t>(text.size(), 1));
  expect(whole == read_in_pieces(text, piece));
  if (!whole.done) {
    judge_body(std::string(text));
    return;
  }
  judge_target(whole.target);
  judge_origin(whole);
  judge_fields(whole);
  judge_body(whole.body);
}

}  // namespace flexrf::fuzz
