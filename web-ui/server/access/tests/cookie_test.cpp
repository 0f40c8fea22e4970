#include "web-ui/server/access/cookie.hpp"

#include "tests/cmocka.hpp"

namespace flexrf::panel::cookie_test {
namespace {

/// The values of "id", with '|' after each.
const char* values_of(const char* header) {
  static std::string text;
  text.clear();
  CookieValues values(header, "id");
  for (std::string_view value = values.next(); value.data() != nullptr; value = values.next())
    text.append(value).append("|");
  return text.c_str();
}

void values_by_name(void**) {
  assert_string_equal(values_of(""), "");
  assert_string_equal(values_of("id=1"), "1|");
  assert_string_equal(values_of("a=b; id=1; xid=2; id2=3;id=4"), "1|4|");
  assert_string_equal(values_of("id="), "|");
  assert_string_equal(values_of("id;=;;; id =1; ID=1"), "");
  assert_string_equal(values_of("id=a=b ;"), "a=b|");
}

void what_set_cookie_says(void**) {
  static std::string text = "what was there";
  write_set_cookie(text, "id", "abc", std::chrono::hours{1}, false);
  assert_string_equal(text.c_str(), "id=abc; Max-Age=3600; Path=/; HttpOnly; SameSite=Strict");
  write_set_cookie(text, "id", "abc", std::chrono::milliseconds{1500}, true);
  assert_string_equal(text.c_str(), "id=abc; Max-Age=1; Path=/; HttpOnly; SameSite=Strict; Secure");
  write_forget_cookie(text, "id", false);
  assert_string_equal(text.c_str(), "id=; Max-Age=0; Path=/; HttpOnly; SameSite=Strict");
}

}  // namespace
}  // namespace flexrf::panel::cookie_test

int main() {
  using namespace flexrf::panel::cookie_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(values_by_name),
      cmocka_unit_test(what_set_cookie_says),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
