#include "web-ui/server/files.hpp"

#include <cstdint>
#include <string>

#include "tests/cmocka.hpp"
#include "web-ui/server/gunzip.hpp"
#include "web-ui/server/gzip.hpp"

namespace flexrf::panel::files_test {
namespace {

using namespace std::string_view_literals;

// "hello, hello, hello, hello\n" by gzip, as our build writes it.
constexpr auto hello =
    "\x1F\x8B\x08\x00\x00\x00\x00\x00\x02\x03\xCB\x48\xCD\xC9\xC9\xD7\x51\xC8\xC0\xA4\xB8\x00\x4B\x21\xA1\x29"
    "\x1B"
    "\x00\x00\x00"sv;
constexpr PageFile page[] = {
    {"/index.html", "text/html; charset=utf-8", "11", false, false, "<!doctype html>"},
    {"/assets/page-1a2b.js", "text/javascript; charset=utf-8", "22", true, true, hello},
    {"/assets/broken.js", "text/javascript; charset=utf-8", "33", true, true, hello.substr(0, 25)},
};
/// Such as compresses well, and some bytes that do not.
std::string make_arm() {
  std::string text = "<robot>";
  for (int i = 0; i < 1000; ++i) text += "<link name=\"link_" + std::to_string(i) + "\"/>";
  return text + "</robot>";
}
const std::string large_arm = make_arm();
const std::string noise = [] {
  std::string text;
  for (std::uint32_t i = 0, state = 1; i < 4000; ++i)
    text += static_cast<char>((state = state * 1664525U + 1013904223U) >> 24U);
  return text;
}();
const PanelFile application[] = {{"arm.urdf", "application/xml", "<robot/>"},
                                 {"large.urdf", "application/xml", large_arm},
                                 {"noise.stl", "model/stl", noise}};

Files files(page, application);
Reply reply;

const Reply& ask(std::string_view path, bool gzip = true, std::string_view if_none_match = {},
                 Method method = Method::get) {
  Request request;
  request.method = method;
  request.path = path;
  request.accepts_gzip = gzip;
  request.if_none_match = if_none_match;
  reply = Reply{};
  assert_true(files.handle(request, reply, {}) == Handled::now);
  return reply;
}

void is(std::string_view actual, std::string_view expected) {
  assert_string_equal(std::string{actual}.c_str(), std::string{expected}.c_str());
}

void the_page_is_asked_for_anew_each_time(void**) {
  ask("/");
  assert_int_equal(reply.status, 200);
  is(reply.cache_control, "no-cache");
  is(reply.content_type, "text/html; charset=utf-8");
  is(reply.etag, "\"11\"");
  assert_true(reply.fixed == page[0].bytes);
  assert_false(reply.varies_by_encoding);
}

void hashed_names_last(void**) {
  ask("/assets/page-1a2b.js");
  is(reply.cache_control, "public, max-age=31536000, immutable");
  is(reply.content_encoding, "gzip");
  assert_true(reply.varies_by_encoding);
  assert_true(reply.fixed == hello);
}

void what_is_unchanged_is_not_sent(void**) {
  assert_int_equal(ask("/", true, "\"11\"").status, 304);
  assert_int_equal(ask("/", true, "\"10\", W/\"11\"").status, 304);
  assert_int_equal(ask("/", true, "*").status, 304);
  assert_int_equal(ask("/", true, "\"10\"").status, 200);
  assert_int_equal(ask("/assets/page-1a2b.js", false, "\"22\"").status, 200);
  assert_int_equal(ask("/assets/page-1a2b.js", false, "\"22-i\"").status, 304);
}

void clients_without_gzip_get_plain_bytes(void**) {
  ask("/assets/page-1a2b.js", false);
  assert_int_equal(reply.status, 200);
  is(reply.content_encoding, "");
  is(reply.etag, "\"22-i\"");
  is(reply.text, "hello, hello, hello, hello\n");
  assert_int_equal(ask("/assets/broken.js", false).status, 500);
}

void the_applications_files_are_served(void**) {
  ask("/application/arm.urdf");
  assert_int_equal(reply.status, 200);
  is(reply.content_type, "application/xml");
  is(reply.cache_control, "no-cache");
  assert_true(reply.fixed == "<robot/>");
  const std::string tag = reply.etag;
  assert_int_equal(ask("/application/arm.urdf", true, tag).status, 304);
  assert_int_equal(ask("/application/other.urdf").status, 404);
  assert_int_equal(ask("/arm.urdf").status, 404);
}

void what_compresses_well_goes_compressed(void**) {
  ask("/application/large.urdf");
  is(reply.content_encoding, "gzip");
  assert_true(reply.varies_by_encoding);
  assert_true(reply.fixed.size() < large_arm.size() / 4);
  std::string text;
  assert_true(gunzip(reply.fixed, text));
  assert_true(text == large_arm);
  const std::string tag = reply.etag;
  ask("/application/large.urdf", false);
  is(reply.content_encoding, "");
  assert_true(reply.fixed == large_arm);
  assert_true(reply.etag != tag);
  ask("/application/noise.stl");
  is(reply.content_encoding, "");
  assert_true(reply.fixed == noise);
}

/// By another's hand: zlib's CRC and size are checked by browsers.
void the_checksum_is_that_of_the_format(void**) {
  const std::string compressed = gzip(std::string(2000, 'a'));
  assert_true(compressed.starts_with("\x1F\x8B\x08"));
  const std::string_view trailer = std::string_view{compressed}.substr(compressed.size() - 8);
  assert_true(trailer == "\x39\x3E\x13\xA8\xD0\x07\x00\x00"sv);
}

void files_can_only_be_read(void**) {
  assert_int_equal(ask("/", true, {}, Method::head).status, 200);
  assert_int_equal(ask("/", true, {}, Method::post).status, 405);
  is(reply.allow, "GET, HEAD");
  is(reply.content_type, "application/problem+json");
}

}  // namespace
}  // namespace flexrf::panel::files_test

int main() {
  using namespace flexrf::panel::files_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_page_is_asked_for_anew_each_time),
      cmocka_unit_test(hashed_names_last),
      cmocka_unit_test(what_is_unchanged_is_not_sent),
      cmocka_unit_test(clients_without_gzip_get_plain_bytes),
      cmocka_unit_test(the_applications_files_are_served),
      cmocka_unit_test(what_compresses_well_goes_compressed),
      cmocka_unit_test(the_checksum_is_that_of_the_format),
      cmocka_unit_test(files_can_only_be_read),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
