#include "base/json_writer.hpp"

#include <cmath>
#include <limits>

#include "tests/cmocka.hpp"

namespace flexrf::json_writer_test {
namespace {

/// CMocka's assertions jump over destructors: the text is copied out of its owner first.
void expect(std::string (*write)(), const char* expected) {
  static char text[1024];
  text[write().copy(text, sizeof(text) - 1)] = '\0';
  assert_string_equal(text, expected);
}

template <class Value>
void expect_written(const Value& value, const char* expected) {
  static char text[256];
  {
    JsonWriter json;
    text[json.value(value).take().copy(text, sizeof(text) - 1)] = '\0';
  }
  assert_string_equal(text, expected);
}

void members_and_elements_have_their_lines(void**) {
  expect(
      [] {
        JsonWriter json;
        json.begin_object().member("name", "jog").key("gains").begin_array().value(1).value(2.5).end_array();
        json.key("none")
            .begin_array()
            .end_array()
            .key("inner")
            .begin_object()
            .member("on", true)
            .end_object();
        json.key("missing").null();
        return json.end_object().take();
      },
      "{\n  \"name\": \"jog\",\n  \"gains\": [\n    1,\n    2.5\n  ],\n  \"none\": [],\n"
      "  \"inner\": {\n    \"on\": true\n  },\n  \"missing\": null\n}\n");
}

void numbers_read_back_the_same(void**) {
  expect_written(0.1, "0.1\n");
  expect_written(1e300, "1e+300\n");
  expect_written(-0.0, "-0\n");
  expect_written(1.0 / 3.0, "0.3333333333333333\n");
  expect_written(std::numeric_limits<std::int64_t>::min(), "-9223372036854775808\n");
  expect_written(std::numeric_limits<std::uint64_t>::max(), "18446744073709551615\n");
  expect_written(std::uint8_t{200}, "200\n");
}

void what_json_has_no_number_for_is_null(void**) {
  expect_written(std::nan(""), "null\n");
  expect_written(std::numeric_limits<double>::infinity(), "null\n");
  expect_written(-std::numeric_limits<double>::infinity(), "null\n");
}

void texts_are_escaped(void**) {
  expect_written("say \"no\" \\ \n\t\x01\x7F", "\"say \\\"no\\\" \\\\ \\n\\u0009\\u0001\\u007f\"\n");
  expect_written("20 \xC2\xB5s \xE2\x82\xAC \xF0\x9F\xA4\x96",
                 "\"20 \xC2\xB5s \xE2\x82\xAC \xF0\x9F\xA4\x96\"\n");
}

void bytes_that_are_no_text_are_replaced(void**) {
  expect_written("a\xFFz", "\"a\xEF\xBF\xBDz\"\n");
  // Cut in the middle of a character, as a cause of bounded length may be.
  expect_written("5 \xE2\x82", "\"5 \xEF\xBF\xBD\xEF\xBF\xBD\"\n");
  // Overlong, a surrogate, beyond U+10FFFF.
  expect_written("\xC0\xAF", "\"\xEF\xBF\xBD\xEF\xBF\xBD\"\n");
  expect_written("\xED\xA0\x80", "\"\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\"\n");
  expect_written("\xF4\x90\x80\x80", "\"\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\"\n");
}

void a_writer_begins_anew_after_take(void**) {
  expect(
      [] {
        JsonWriter json;
        json.begin_array().value(1).end_array();
        const std::string first = json.take();
        return first + json.begin_array().value(2).end_array().take();
      },
      "[\n  1\n]\n[\n  2\n]\n");
}

void compact_text_has_no_blanks_and_keeps_its_memory(void**) {
  expect(
      [] {
        std::string text = "id: ";
        text.reserve(256);
        const char* const memory = text.data();
        JsonWriter json(std::move(text));
        json.begin_object().member("a", 1).key("b").raw("[2]").key("c").begin_array();
        json.value("x").null().end_array().key("d").begin_object().end_object().end_object();
        text = json.release();
        return text.data() == memory ? text : "another memory";
      },
      R"(id: {"a":1,"b":[2],"c":["x",null],"d":{}})");
}

}  // namespace
}  // namespace flexrf::json_writer_test

int main() {
  using namespace flexrf::json_writer_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(members_and_elements_have_their_lines),
      cmocka_unit_test(numbers_read_back_the_same),
      cmocka_unit_test(what_json_has_no_number_for_is_null),
      cmocka_unit_test(texts_are_escaped),
      cmocka_unit_test(bytes_that_are_no_text_are_replaced),
      cmocka_unit_test(a_writer_begins_anew_after_take),
      cmocka_unit_test(compact_text_has_no_blanks_and_keeps_its_memory),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
