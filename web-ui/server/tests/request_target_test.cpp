#include "web-ui/server/request_target.hpp"

#include <string>

#include "tests/cmocka.hpp"

namespace flexrf::panel::request_target_test {
namespace {

struct Target {
  const char* target;
  const char* path;  ///< null: refused
  const char* query;
};

void targets_are_decoded(void**) {
  const Target cases[] = {
      {"/", "/", ""},
      {"/a/b?c=%20d", "/a/b", "c=%20d"},
      {"/axis%5B2%5D.drive", "/axis[2].drive", ""},
      {"/%c3%a4", "/\xC3\xA4", ""},
      {"/..a/.b/c..", "/..a/.b/c..", ""},
      {"", nullptr, ""},
      {"a", nullptr, ""},
      {"*", nullptr, ""},
      {"http://a/b", nullptr, ""},
      {"/%", nullptr, ""},
      {"/%4", nullptr, ""},
      {"/%4g", nullptr, ""},
      {"/%00", nullptr, ""},
      {"/%0a", nullptr, ""},
      {"/a\\b", nullptr, ""},
      {"/a/../b", nullptr, ""},
      {"/a/%2E", nullptr, ""},
      {"/..", nullptr, ""},
  };
  for (const Target& one : cases) {
    char memory[64];
    const std::optional<RequestTarget> target = decode_target(one.target, memory);
    if (target.has_value() != (one.path != nullptr)) print_error("%s\n", one.target);
    assert_int_equal(target.has_value(), one.path != nullptr);
    if (!target) continue;
    assert_true(target->path == one.path);
    assert_true(target->query == one.query);
  }
}

void gzip_is_found(void**) {
  assert_true(accepts_gzip("gzip"));
  assert_true(accepts_gzip("br, GZip;q=0.5"));
  assert_true(accepts_gzip("*"));
  assert_true(accepts_gzip("gzip; q=1"));
  assert_false(accepts_gzip(""));
  assert_false(accepts_gzip("br, deflate"));
  assert_false(accepts_gzip("gzip;q=0"));
  assert_false(accepts_gzip("gzip;q=0.000"));
  assert_false(accepts_gzip("xgzip"));
}

void lists_are_searched(void**) {
  assert_true(list_has("a, flexrf.v1", "flexrf.v1"));
  assert_true(list_has("flexrf.v1", "flexrf.v1"));
  assert_false(list_has("flexrf.v12", "flexrf.v1"));
  assert_false(list_has("", "flexrf.v1"));
  assert_true(is_media_type("application/json", "application/json"));
  assert_true(is_media_type("Application/JSON ; charset=utf-8", "application/json"));
  assert_false(is_media_type("application/jsonp", "application/json"));
  assert_false(is_media_type("text/plain", "application/json"));
  assert_false(is_media_type("", "application/json"));
}

void tags_are_compared(void**) {
  assert_true(names_tag("\"a\"", "\"a\""));
  assert_true(names_tag("\"b\" , W/\"a\"", "\"a\""));
  assert_true(names_tag("*", "\"a\""));
  assert_false(names_tag("a", "\"a\""));
  assert_false(names_tag("", "\"a\""));
}

}  // namespace
}  // namespace flexrf::panel::request_target_test

int main() {
  using namespace flexrf::panel::request_target_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(targets_are_decoded),
      cmocka_unit_test(gzip_is_found),
      cmocka_unit_test(lists_are_searched),
      cmocka_unit_test(tags_are_compared),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
