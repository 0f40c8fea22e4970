#include "runtime/core/value_json.hpp"

#include <cstddef>
#include <cstring>

#include "tests/cmocka.hpp"

namespace flexrf::value_json_test {
namespace {

struct Point {
  double x;
  bool seen;
};
constexpr FieldDescriptor point_fields[] = {
    {"x", Scalar::f64, 0, {0, 0}, 1, offsetof(Point, x), "m", "", nullptr},
    {"seen", Scalar::boolean, 0, {0, 0}, 1, offsetof(Point, seen), "", "", nullptr},
};
constexpr TypeDescriptor point_type{"Point", "", sizeof(Point), alignof(Point), 1, point_fields,
                                    {},      {}, false};

constexpr EnumerationValue colours[] = {{"red", ""}, {"green", ""}};
constexpr TypeDescriptor colour_type{"Colour", "", 1, 1, 2, {}, {}, colours, false};

struct Sample {
  std::uint64_t large;
  std::int8_t small;
  std::uint8_t colour;
  std::uint8_t no_colour;
  char text[4];
  std::int16_t matrix[6];  // 2 rows, 3 columns, column by column
  Point points[2];
};
constexpr FieldDescriptor sample_fields[] = {
    {"large", Scalar::u64, 0, {0, 0}, 1, offsetof(Sample, large), "", "", nullptr},
    {"small", Scalar::i8, 0, {0, 0}, 1, offsetof(Sample, small), "", "", nullptr},
    {"colour", Scalar::enumeration, 0, {0, 0}, 1, offsetof(Sample, colour), "", "", &colour_type},
    {"no_colour", Scalar::enumeration, 0, {0, 0}, 1, offsetof(Sample, no_colour), "", "", &colour_type},
    {"text", Scalar::text, 0, {0, 0}, 4, offsetof(Sample, text), "", "", nullptr},
    {"matrix", Scalar::i16, 2, {2, 3}, 6, offsetof(Sample, matrix), "", "", nullptr},
    {"points", Scalar::structure, 1, {2, 0}, 2, offsetof(Sample, points), "", "", &point_type},
};
constexpr TypeDescriptor sample_type{"Sample", "", sizeof(Sample), alignof(Sample), 3, sample_fields,
                                     {},       {}, false};

/// Without blanks and line feeds, which are the writer's affair.
void expect(const Sample& sample, const char* expected) {
  static char text[1024];
  {
    JsonWriter json;
    write_value(json, sample_type, &sample);
    std::size_t size = 0;
    for (const char character : json.take())
      if (character != ' ' && character != '\n') text[size++] = character;
    text[size] = '\0';
  }
  assert_string_equal(text, expected);
}

void every_kind_of_field_is_written(void**) {
  const Sample sample{
      18446744073709551615U,        -128, 1, 7, {'f', 'u', 'l', 'l'}, {11, 21, 12, 22, 13, 23},
      {{0.5, true}, {-1e-9, false}}};
  expect(sample,
         "{\"large\":18446744073709551615,\"small\":-128,\"colour\":\"green\",\"no_colour\":7,"
         "\"text\":\"full\",\"matrix\":[[11,12,13],[21,22,23]],"
         "\"points\":[{\"x\":0.5,\"seen\":true},{\"x\":-1e-09,\"seen\":false}]}");
}

void zeroed_memory_is_a_value(void**) {
  expect(Sample{},
         "{\"large\":0,\"small\":0,\"colour\":\"red\",\"no_colour\":\"red\",\"text\":\"\","
         "\"matrix\":[[0,0,0],[0,0,0]],\"points\":[{\"x\":0,\"seen\":false},{\"x\":0,\"seen\":false}]}");
}

}  // namespace
}  // namespace flexrf::value_json_test

int main() {
  using namespace flexrf::value_json_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(every_kind_of_field_is_written),
      cmocka_unit_test(zeroed_memory_is_a_value),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
