#include "runtime/parameters/value_access.hpp"

#include <cmath>
#include <cstring>
#include <limits>

#include "runtime/parameters/tests/sample_component.hpp"
#include "tests/cmocka.hpp"

namespace flexrf::value_access_test {
namespace {

using sample::Configuration;
using sample::Runtime;

FieldPlace place_of(const TypeDescriptor& type, const char* path) {
  const Result<FieldPlace> place = find_field(type, path);
  assert_true(static_cast<bool>(place));
  return *place;
}

const char* failure_of(const TypeDescriptor& type, const char* path) {
  static char cause[Status::cause_capacity];
  const Result<FieldPlace> place = find_field(type, path);
  assert_false(static_cast<bool>(place));
  std::strcpy(cause, place.status().cause());
  return cause;
}

void expect_text(const TypeDescriptor& type, const char* path, const void* values, const char* expected) {
  char text[256];
  std::snprintf(text, sizeof(text), "%s", text_of(place_of(type, path), values).c_str());
  assert_string_equal(text, expected);
}

void expect_refused(const TypeDescriptor& type, const char* path, const char* text, const char* cause,
                    const ValueRange* range = nullptr) {
  union {
    Configuration configuration;
    Runtime runtime;
    unsigned char bytes[sizeof(Configuration) + sizeof(Runtime)];
  } values{};
  std::memset(&values, 0x5A, sizeof(values));
  const Status status = write_text(place_of(type, path), &values, text, range);
  assert_false(status.is_ok());
  assert_string_equal(status.cause(), cause);
  for (const unsigned char byte : values.bytes) assert_int_equal(byte, 0x5A);
}

void fields_are_found_by_path(void**) {
  assert_int_equal(place_of(sample::runtime_type, "step").offset, offsetof(Runtime, step));
  assert_int_equal(place_of(sample::runtime_type, "gains").count, 3);
  const FieldPlace gain = place_of(sample::runtime_type, "gains[2]");
  assert_int_equal(gain.offset, offsetof(Runtime, gains) + 2 * sizeof(float));
  assert_int_equal(gain.count, 1);
  // Row 1, column 2 of two rows stored column by column.
  assert_int_equal(place_of(sample::configuration_type, "rotation[1][2]").offset,
                   offsetof(Configuration, rotation) + 5 * sizeof(double));
  assert_int_equal(place_of(sample::configuration_type, "limits[1].high").offset,
                   offsetof(Configuration, limits) + sizeof(sample::Limits) + offsetof(sample::Limits, high));

  assert_string_equal(failure_of(sample::runtime_type, "stpe"),
                      "no 'stpe' in sample.runtime; did you mean 'step'?");
  assert_string_equal(failure_of(sample::runtime_type, "qqqqq"), "no 'qqqqq' in sample.runtime");
  assert_string_equal(failure_of(sample::runtime_type, ""), "no '' in sample.runtime");
  assert_string_equal(failure_of(sample::runtime_type, "gains[3]"), "index 3 of 'gains' lies outside 0 to 2");
  assert_string_equal(failure_of(sample::runtime_type, "gains["), "'gains' wants an index as in 'gains[0]'");
  assert_string_equal(failure_of(sample::runtime_type, "gains[-1]"),
                      "'gains' wants an index as in 'gains[0]'");
  assert_string_equal(failure_of(sample::runtime_type, "step[0]"),
                      "'step' is a single value and has no index");
  assert_string_equal(failure_of(sample::runtime_type, "step.x"), "'step' is not a structure and has no 'x'");
  assert_string_equal(failure_of(sample::configuration_type, "rotation[1]"),
                      "'rotation' wants row and column, as in 'rotation[0][0]'");
  assert_string_equal(failure_of(sample::configuration_type, "limits.low"),
                      "'limits' wants an index as in 'limits[0]'");
  assert_string_equal(failure_of(sample::configuration_type, "limits[0].lo"),
                      "no 'lo' in Limits; did you mean 'low'?");
}

void values_become_text_and_return(void**) {
  expect_text(sample::runtime_type, "step", &sample::default_runtime, "0.01");
  expect_text(sample::runtime_type, "gains", &sample::default_runtime, "1 2 3");
  expect_text(sample::runtime_type, "gains[1]", &sample::default_runtime, "2");
  expect_text(sample::runtime_type, "mode", &sample::default_runtime, "manual");
  expect_text(sample::runtime_type, "enabled", &sample::default_runtime, "false");
  expect_text(sample::runtime_type, "small", &sample::default_runtime, "-5");
  expect_text(sample::configuration_type, "title", &sample::default_configuration, "home");
  expect_text(sample::configuration_type, "rotation", &sample::default_configuration, "1 3 -2; 2 -1 -3");
  expect_text(sample::configuration_type, "limits[1].low", &sample::default_configuration, "2");

  Configuration configuration{};
  const auto write = [&configuration](const char* path, const char* text) {
    assert_true(
        write_text(place_of(sample::configuration_type, path), &configuration, text, nullptr).is_ok());
  };
  write("rotation", " 1 3 -2 ;\n 2 -1 -3 ");
  assert_memory_equal(configuration.rotation, sample::default_configuration.rotation,
                      sizeof(configuration.rotation));
  write("title", "Größe");
  assert_string_equal(configuration.title, "Größe");
  write("title", "exactly sixteen!");
  assert_memory_equal(configuration.title, "exactly sixteen!", 16);
  expect_text(sample::configuration_type, "title", &configuration, "exactly sixteen!");
  write("limits[0].high", "+0.1");
  assert_true(configuration.limits[0].high == 0.1F);
  expect_text(sample::configuration_type, "limits[0].high", &configuration, "0.1");

  Runtime runtime{};
  const auto write_runtime = [&runtime](const char* path, const char* text) {
    assert_true(write_text(place_of(sample::runtime_type, path), &runtime, text, nullptr).is_ok());
  };
  write_runtime("large", "18446744073709551615");
  assert_true(runtime.large == std::numeric_limits<std::uint64_t>::max());
  expect_text(sample::runtime_type, "large", &runtime, "18446744073709551615");
  write_runtime("mode", "automatic");
  assert_int_equal(runtime.mode, 2);
  write_runtime("enabled", "true");
  assert_true(runtime.enabled);
  write_runtime("step", "1.2345678901234567e-300");
  assert_true(runtime.step == 1.2345678901234567e-300);
}

void wrong_text_changes_nothing_and_says_why(void**) {
  const ValueRange range{0.001, 0.1};
  const TypeDescriptor& runtime = sample::runtime_type;
  const TypeDescriptor& configuration = sample::configuration_type;
  expect_refused(runtime, "step", "0.5", "step: 0.5 m lies outside 0.001 to 0.1 m", &range);
  expect_refused(runtime, "step", "1e999", "step: 1e999 lies outside 0.001 to 0.1", &range);
  expect_refused(runtime, "step", "nan", "step: nan is not a finite number");
  expect_refused(runtime, "step", "-inf", "step: -inf is not a finite number");
  expect_refused(runtime, "step", "fast", "step: 'fast' is not a number");
  expect_refused(runtime, "step", "0.01m", "step: '0.01m' is not a number");
  expect_refused(runtime, "step", "", "step: wants 1 value, but there are 0");
  expect_refused(runtime, "step", "1 2", "step: wants 1 value, but there are 2");
  expect_refused(runtime, "gains", "1 2", "gains: wants 3 values, but there are 2");
  expect_refused(runtime, "gains", "1 2 x", "gains, value 3: 'x' is not a number");
  expect_refused(runtime, "small", "128", "small: 128 does not fit its type");
  expect_refused(runtime, "small", "1.5", "small: '1.5' is not an integer");
  expect_refused(runtime, "large", "-1", "large: -1 does not fit its type");
  expect_refused(runtime, "mode", "manuel", "mode: 'manuel' is no Mode; did you mean 'manual'?");
  expect_refused(runtime, "mode", "qqqqqq", "mode: 'qqqqqq' is no Mode: off, manual, automatic");
  expect_refused(runtime, "enabled", "yes", "enabled: 'yes' is neither true nor false");
  expect_refused(runtime, "go", "1", "go: takes no text");
  expect_refused(runtime, "limits", "1", "limits: is a structure: name its members");
  expect_refused(configuration, "title", "seventeen letters",
                 "title: 17 bytes of text, but there is room for 16");
  expect_refused(configuration, "title", "bell \a", "title: control character 7 in the text");
  expect_refused(configuration, "title", "\xC0\x80", "title: byte 0 of the text is not UTF-8");
  expect_refused(configuration, "title", "a\xED\xA0\x80", "title: byte 1 of the text is not UTF-8");
  const char* const wanted = "rotation: wants 2 rows of 3 values, the rows separated by ';'";
  expect_refused(configuration, "rotation", "1 2 3 4 5 6", wanted);
  expect_refused(configuration, "rotation", "1 2; 3 4; 5 6", wanted);
  expect_refused(configuration, "rotation", "1 2 3; 4 5", wanted);
  expect_refused(configuration, "rotation", "1 2 3; 4 5 6;", wanted);
  expect_refused(configuration, "rotation", "1 2 3;; 4 5 6", wanted);
}

void values_are_checked_element_by_element(void**) {
  Runtime runtime = sample::default_runtime;
  std::uint16_t index = 99;
  const ParameterBlock& block = sample::component_type.runtime;
  assert_true(check_block(block, &runtime, index).is_ok());
  assert_int_equal(index, 99);

  runtime.gains[1] = 10.5F;
  Status status = check_block(block, &runtime, index);
  assert_string_equal(status.cause(), "gains[1]: 10.5 lies outside 0 to 10");
  assert_int_equal(index, sample::gains);

  runtime = sample::default_runtime;
  runtime.limits.high = std::numeric_limits<float>::quiet_NaN();
  status = check_block(block, &runtime, index);
  assert_string_equal(status.cause(), "limits.high: nan is not a finite number");

  runtime = sample::default_runtime;
  runtime.mode = 3;
  status = check_block(block, &runtime, index);
  assert_string_equal(status.cause(), "mode: 3 is no value of Mode, which has 3");

  runtime = sample::default_runtime;
  std::memset(&runtime.enabled, 2, 1);
  status = check_block(block, &runtime, index);
  assert_string_equal(status.cause(), "enabled: neither false nor true");

  Configuration configuration = sample::default_configuration;
  configuration.rotation[5] = 9;
  configuration.limits[1].low = INFINITY;
  status = check_block(sample::component_type.configuration, &configuration, index);
  assert_string_equal(status.cause(), "rotation[1][2]: 9 rad lies outside -4 to 4 rad");
  configuration.rotation[5] = 0;
  status = check_block(sample::component_type.configuration, &configuration, index);
  assert_string_equal(status.cause(), "limits[1].low: inf is not a finite number");
}

void bytes_are_taken_as_whole_elements_or_members(void**) {
  const FieldDescriptor& rotation = sample::configuration_fields[3];
  assert_true(is_whole(rotation, 0, 48));
  assert_true(is_whole(rotation, 8, 16));
  assert_false(is_whole(rotation, 4, 8));
  assert_false(is_whole(rotation, 0, 12));
  assert_false(is_whole(rotation, 40, 16));
  assert_false(is_whole(rotation, 0, 0));
  assert_false(is_whole(rotation, 0xFFFFFFF8U, 8));
  const FieldDescriptor& title = sample::configuration_fields[2];
  assert_true(is_whole(title, 0, 16));
  assert_false(is_whole(title, 0, 8));
  const FieldDescriptor& limits = sample::configuration_fields[4];
  assert_true(is_whole(limits, 0, 32));
  assert_true(is_whole(limits, 16, 16));
  assert_true(is_whole(limits, 16, 8));
  assert_true(is_whole(limits, 24, 4));
  assert_false(is_whole(limits, 28, 4));
  assert_false(is_whole(limits, 8, 16));
}

void numbers_are_read_and_written_exactly(void**) {
  Runtime runtime = sample::default_runtime;
  const auto write = [&runtime](const char* path, double number, const ValueRange* range = nullptr) {
    return write_number(place_of(sample::runtime_type, path), &runtime, number, range).is_ok();
  };
  const auto read = [&runtime](const char* path, std::uint32_t element = 0) {
    return *read_number(place_of(sample::runtime_type, path), &runtime, element);
  };
  assert_true(read("gains", 2) == 3.0);
  assert_true(read("small") == -5.0);
  assert_true(read("mode") == 1.0);
  assert_true(read("go") == 0.0);
  assert_false(static_cast<bool>(read_number(place_of(sample::runtime_type, "gains"), &runtime, 3)));
  assert_false(static_cast<bool>(read_number(place_of(sample::runtime_type, "limits"), &runtime)));

  assert_true(write("small", -128));
  assert_int_equal(runtime.small, -128);
  assert_false(write("small", 128));
  assert_false(write("small", 0.5));
  assert_int_equal(runtime.small, -128);
  assert_true(write("large", 9007199254740992.0));
  assert_false(write("large", 18446744073709551616.0));
  assert_false(write("large", -1));
  assert_true(runtime.large == 9007199254740992U);
  assert_false(write("step", NAN));
  assert_false(write("gains[0]", 1e300));
  const ValueRange range{0, 1};
  assert_false(write("step", 1.5, &range));
  assert_true(write("step", 1, &range));
  assert_true(write("enabled", 1));
  assert_false(write("enabled", 2));
  assert_true(write("mode", 2));
  assert_false(write("mode", 3));
  assert_false(write("go", 1));
}

}  // namespace
}  // namespace flexrf::value_access_test

int main() {
  using namespace flexrf::value_access_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(fields_are_found_by_path),
      cmocka_unit_test(values_become_text_and_return),
      cmocka_unit_test(wrong_text_changes_nothing_and_says_why),
      cmocka_unit_test(values_are_checked_element_by_element),
      cmocka_unit_test(bytes_are_taken_as_whole_elements_or_members),
      cmocka_unit_test(numbers_are_read_and_written_exactly),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
