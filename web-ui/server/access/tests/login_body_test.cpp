#include "web-ui/server/access/login_body.hpp"

#include "tests/cmocka.hpp"

namespace flexrf::panel::login_body_test {
namespace {

bool reads(std::string_view text) {
  static LoginBody body;
  body = {};
  return read_login_body(text, body) && body.user == "ann" && body.password == "s3cret \"\xC3\xA4";
}

void what_a_client_sends(void**) {
  assert_true(reads(R"({"user":"ann","password":"s3cret \"\u00e4"})"));
  assert_true(reads(" {\n\"password\" : \"s3cret \\\"\xC3\xA4\", \"user\":\"ann\" } "));
}

void nothing_else_is_taken(void**) {
  static LoginBody body;
  for (const char* text :
       {"", "{}", "null", "[]", R"("ann")", R"({"user":"a"})", R"({"password":"a"})",
        R"({"user":"a","password":1})", R"({"user":"a","password":null})",
        R"({"user":"a","password":"b","role":"admin"})", R"({"user":"a","password":"b","user":"c"})",
        R"({"user":"a","password":["b"]})", R"({"user":{"user":"a"},"password":"b"})",
        R"([{"user":"a","password":"b"}])", R"({"user":"a","password":"b"}x)",
        R"({"user":"a","password":"b")", R"({"user":"a","password":"b",})",
        "{\"user\":\"a\",\"password\":\"\xFF\"}", R"({"user":"a","password":"\ud800"})"})
    assert_false(read_login_body(text, body));
}

void neither_length_nor_depth_hurts(void**) {
  static LoginBody body;
  static const std::string deep(1000, '[');
  static const std::string large = R"({"user":"a","password":")" + std::string(2000, 'x') + "\"}";
  assert_false(read_login_body(deep, body));
  assert_false(read_login_body(large, body));
}

}  // namespace
}  // namespace flexrf::panel::login_body_test

int main() {
  using namespace flexrf::panel::login_body_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(what_a_client_sends),
      cmocka_unit_test(nothing_else_is_taken),
      cmocka_unit_test(neither_length_nor_depth_hurts),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
