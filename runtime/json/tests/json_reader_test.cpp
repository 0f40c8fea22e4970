// JSON from outside: what is taken, what is refused, and with which words.
#include "runtime/json/json_reader.hpp"

#include <string>

#include "runtime/executive/tests/checks.hpp"

namespace flexrf {
namespace {

std::string cause_of(const std::string& text) {
  JsonReader reader;
  const Result<JsonObject> object = reader.object(text);
  return object ? "" : object.status().cause();
}

void one_object_and_nothing_else() {
  CHECK_EQUAL(cause_of(R"({"op": "ping", "id": 1, "list": [1, {"a": null}]})"), "");
  for (const char* const text :
       {"", " ", "{", "{}{}", "{} x", "{\"a\": }", "{\"a\": NaN}", "{\"a\": Infinity}", "{\"a\": 1e999}",
        "{\"a\": 123456789012345678901234567890}", "{'a': 1}", "{\"a\": \"\xFF\"}", "{\"a\": \"\x01\"}",
        "{\"a\": 01}"})
    CHECK_CONTAINS(cause_of(text), "no JSON");
  CHECK_CONTAINS(cause_of("[1]"), "no object");
  CHECK_CONTAINS(cause_of("7"), "no object");
}

void names_come_once() {
  CHECK_CONTAINS(cause_of(R"({"a": 1, "b": 2, "a": 3})"), "'a' comes twice");
  CHECK_CONTAINS(cause_of(R"({"x": [{"y": {"k": 1, "k": 1}}]})"), "'k' comes twice");
}

void size_depth_and_members_are_bounded() {
  std::string deep(JsonReader::max_depth + 4, '[');
  CHECK_CONTAINS(cause_of("{\"a\": " + deep + std::string(deep.size(), ']') + "}"), "16 levels");
  CHECK_CONTAINS(cause_of("{\"a\": \"" + std::string(JsonReader::max_bytes, 'x') + "\"}"), "16384 bytes");
  std::string many = "{";
  for (std::size_t i = 0; i <= JsonReader::max_members; ++i)
    many += (i == 0 ? "\"" : ",\"") + std::to_string(i) + "\":0";
  CHECK_CONTAINS(cause_of(many + "}"), "more than 128 members");
}

void integers_are_exact() {
  JsonReader reader;
  const Result<JsonObject> object =
      reader.object(R"({"large": 18446744073709551615, "below": -1, "real": 1.5, "text": "t"})");
  CHECK(object);
  Fields fields(*object);
  CHECK_EQUAL(fields.integer("large"), 18446744073709551615ULL);
  CHECK_EQUAL(fields.text("text"), "t");
  CHECK(fields.status().is_ok());
  CHECK_EQUAL(fields.integer("below"), 0U);
  CHECK_CONTAINS(fields.status().cause(), "'below' is not an integer from 0");
  Fields others(*object);
  CHECK_EQUAL(others.text("absent"), "");
  CHECK_CONTAINS(others.status().cause(), "'absent' is missing; it is a text");
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(one_object_and_nothing_else),
      CONTAINED_TEST(names_come_once),
      CONTAINED_TEST(size_depth_and_members_are_bounded),
      CONTAINED_TEST(integers_are_exact),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
