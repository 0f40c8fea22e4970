#include "web-ui/server/json_text.hpp"

#include <string>

#include "tests/cmocka.hpp"

namespace flexrf::panel {
namespace {

struct Case {
  const char* text;
  const char* json;
};

void text_is_escaped(void**) {
  const Case cases[] = {
      {"", R"("")"},
      {"plain", R"("plain")"},
      {"\"\\/", R"("\"\\/")"},
      {"a\nb\rc\td\x01\x1F", R"("a\nb\rc\td\u0001\u001f")"},
      {"\xC2\xB5m \xE2\x82\xAC \xF0\x9F\x98\x80", "\"\xC2\xB5m \xE2\x82\xAC \xF0\x9F\x98\x80\""},
      {"\xFF", "\"\xEF\xBF\xBD\""},
      {"\xC0\xAF", "\"\xEF\xBF\xBD\xEF\xBF\xBD\""},                                  // overlong
      {"\xED\xA0\x80", "\"\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\""},                  // a surrogate
      {"\xE2\x82", "\"\xEF\xBF\xBD\xEF\xBF\xBD\""},                                  // cut
      {"\xF4\x90\x80\x80", "\"\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\""},  // beyond U+10FFFF
  };
  for (const Case& one : cases) {
    std::string json;
    append_json_text(json, one.text);
    const bool same = json == one.json;
    if (!same) print_error("%s: %s\n", one.json, json.c_str());
    json = {};
    assert_true(same);
  }
}

}  // namespace
}  // namespace flexrf::panel

int main() {
  using namespace flexrf::panel;
  const CMUnitTest tests[] = {cmocka_unit_test(text_is_escaped)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
