// Values from JSON into plain structs: every shape, exactly, or a cause that names the place.
#include "runtime/json/value_reader.hpp"

#include <cstddef>
#include <string>

#include "runtime/executive/tests/checks.hpp"

namespace flexrf {
namespace {

struct Point {
  double x;
  std::int8_t small;
};
struct Everything {
  std::int64_t large;
  std::uint64_t larger;
  float real;
  std::uint8_t on;
  std::uint8_t colour;
  char text[8];
  double list[3];
  double matrix[4];  // 2 x 2
  Point points[2];
};

constexpr EnumerationValue colours[] = {{"red", ""}, {"green", ""}};
constexpr TypeDescriptor colour_type{"Colour", "", 1, 1, 1, {}, {}, colours, false};
constexpr FieldDescriptor point_fields[] = {
    {"x", Scalar::f64, 0, {0, 0}, 1, offsetof(Point, x), "m", "", nullptr},
    {"small", Scalar::i8, 0, {0, 0}, 1, offsetof(Point, small), "1", "", nullptr}};
constexpr TypeDescriptor point_type{"Point", "", sizeof(Point), alignof(Point), 2, point_fields,
                                    {},      {}, false};
constexpr FieldDescriptor fields[] = {
    {"large", Scalar::i64, 0, {0, 0}, 1, offsetof(Everything, large), "1", "", nullptr},
    {"larger", Scalar::u64, 0, {0, 0}, 1, offsetof(Everything, larger), "1", "", nullptr},
    {"real", Scalar::f32, 0, {0, 0}, 1, offsetof(Everything, real), "m", "", nullptr},
    {"on", Scalar::boolean, 0, {0, 0}, 1, offsetof(Everything, on), "", "", nullptr},
    {"colour", Scalar::enumeration, 0, {0, 0}, 1, offsetof(Everything, colour), "", "", &colour_type},
    {"text", Scalar::text, 0, {0, 0}, 8, offsetof(Everything, text), "", "", nullptr},
    {"list", Scalar::f64, 1, {3, 0}, 3, offsetof(Everything, list), "m", "", nullptr},
    {"matrix", Scalar::f64, 2, {2, 2}, 4, offsetof(Everything, matrix), "1", "", nullptr},
    {"points", Scalar::structure, 1, {2, 0}, 2, offsetof(Everything, points), "", "", &point_type}};
constexpr TypeDescriptor everything_type{
    "Everything", "", sizeof(Everything), alignof(Everything), 3, fields, {}, {}, false};

std::string read(const std::string& path, const std::string& value, Everything& into,
                 const ValueRange* range = nullptr) {
  static JsonReader reader;
  const Result<JsonObject> object = reader.object("{\"v\": " + value + "}");
  if (!object) return object.status().cause();
  const Result<FieldPlace> place = find_field(everything_type, path);
  if (!place) return place.status().cause();
  const Status status = read_value(object->at_key("v").value_unsafe(), *place, &into, range);
  return status ? "" : status.cause();
}

void every_shape_is_read() {
  Everything into{};
  CHECK_EQUAL(read("large", "-9223372036854775808", into), "");
  CHECK(into.large == INT64_MIN);
  CHECK_EQUAL(read("larger", "18446744073709551615", into), "");
  CHECK(into.larger == UINT64_MAX);
  CHECK_EQUAL(read("larger", "1e3", into), "");
  CHECK(into.larger == 1000);
  CHECK_EQUAL(read("real", "3", into), "");
  CHECK(into.real == 3.0F);
  CHECK_EQUAL(read("on", "true", into), "");
  CHECK(into.on == 1);
  CHECK_EQUAL(read("colour", "\"green\"", into), "");
  CHECK(into.colour == 1);
  CHECK_EQUAL(read("text", "\"12345678\"", into), "");
  CHECK(std::string(into.text, 8) == "12345678");
  CHECK_EQUAL(read("list", "[1, 2.5, -3]", into), "");
  CHECK(into.list[2] == -3);
  CHECK_EQUAL(read("list[1]", "7", into), "");
  CHECK(into.list[1] == 7);
  CHECK_EQUAL(read("matrix", "[[1, 2], [3, 4]]", into), "");
  CHECK(into.matrix[1] == 3 && into.matrix[2] == 2);  // column by column
  CHECK_EQUAL(read("matrix[0][1]", "9", into), "");
  CHECK(into.matrix[2] == 9);
  CHECK_EQUAL(read("points", R"([{"x": 1, "small": 2}, {"x": 3, "small": -128}])", into), "");
  CHECK(into.points[1].small == -128);
  CHECK_EQUAL(read("points[0]", R"({"x": 5, "small": 6})", into), "");
  CHECK_EQUAL(read("points[1].x", "8", into), "");
  CHECK(into.points[0].x == 5 && into.points[1].x == 8);
}

void what_does_not_fit_is_refused() {
  Everything into{};
  CHECK_CONTAINS(read("large", "1.5", into), "wants an integer from");
  CHECK_CONTAINS(read("large", "\"1\"", into), "wants an integer");
  CHECK_CONTAINS(read("points[0].small", "128", into), "from -128 to 127");
  CHECK_CONTAINS(read("larger", "-1", into), "wants an integer from 0");
  CHECK_CONTAINS(read("real", "1e300", into), "not a finite number");
  CHECK_CONTAINS(read("real", "null", into), "wants a number");
  CHECK_CONTAINS(read("on", "1", into), "wants true or false");
  CHECK_CONTAINS(read("colour", "\"gren\"", into), "did you mean 'green'?");
  CHECK_CONTAINS(read("colour", "1", into), "the name of a value");
  CHECK_CONTAINS(read("text", "\"123456789\"", into), "at most 8 fit");
  CHECK_CONTAINS(read("text", "\"a\\u0000b\"", into), "character 0");
  CHECK_CONTAINS(read("list", "[1, 2]", into), "wants a list of 3");
  CHECK_CONTAINS(read("matrix", "[[1, 2], [3]]", into), "row 1 wants a list of 2");
  CHECK_CONTAINS(read("points[0]", R"({"x": 1})", into), "the member 'small' is missing");
  CHECK_CONTAINS(read("points[0]", R"({"x": 1, "smal": 2})", into), "did you mean 'small'?");
  const ValueRange range{0, 5};
  CHECK_CONTAINS(read("list", "[1, 2, 6]", into, &range), "list[2]: 6 m lies outside 0 to 5 m");
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {CONTAINED_TEST(every_shape_is_read),
                              CONTAINED_TEST(what_does_not_fit_is_refused)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
