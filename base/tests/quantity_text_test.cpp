// Durations and sizes with their units, there and back.
#include "base/quantity_text.hpp"

#include <initializer_list>

#include "base/tests/expect_text.hpp"

namespace flexrf::quantity_text_test {
namespace {

void durations_have_three_digits_and_their_unit(void**) {
  expect(duration_text(Duration{0}), "0 ns");
  expect(duration_text(Duration{7}), "7 ns");
  expect(duration_text(Duration{999}), "999 ns");
  expect(duration_text(Duration{1000}), "1.00 us");
  expect(duration_text(Duration{12'345}), "12.3 us");
  expect(duration_text(Duration{123'456}), "123 us");
  expect(duration_text(Duration{999'600}), "1.00 ms");
  expect(duration_text(Duration{-1'500'000}), "-1.50 ms");
  expect(duration_text(std::chrono::seconds{45}), "45.0 s");
  expect(duration_text(std::chrono::seconds{90}), "1.50 min");
  expect(duration_text(std::chrono::hours{100}), "100 h");
  expect(duration_if_any(Duration{7}), "7 ns");
  expect(duration_if_any(Duration{}), "");
}

void sizes_too(void**) {
  expect(size_text(0), "0 B");
  expect(size_text(1023), "1023 B");
  expect(size_text(1536), "1.50 KiB");
  expect(size_text(8U * 1024 * 1024), "8.00 MiB");
  expect(size_text(std::uint64_t{5} << 40), "5120 GiB");
}

void hashes_have_all_their_digits(void**) {
  expect(hexadecimal_text(0xAB), "00000000000000ab");
  expect(hexadecimal_text(~std::uint64_t{0}), "ffffffffffffffff");
}

void durations_are_read_in_each_unit(void**) {
  assert_true(parse_duration("250 ns") == Duration{250});
  assert_true(parse_duration("300us") == Duration{300'000});
  assert_true(parse_duration("7 ms") == Duration{7'000'000});
  assert_true(parse_duration("1.5 s") == Duration{1'500'000'000});
  assert_true(parse_duration("0.5min") == std::chrono::seconds{30});
  assert_true(parse_duration("100 h") == std::chrono::hours{100});
  assert_true(parse_duration("0 s") == Duration{0});
  // 0.3 * 1e3 is no whole number to a computer.
  assert_true(parse_duration("0.3 us") == Duration{300});
  assert_true(parse_duration("9000000000 s") == std::chrono::seconds{9'000'000'000});
}

void what_is_no_duration_is_nothing(void**) {
  for (const char* const text : {"", " ", "7", "ms", " 7 ms", "7  ms", "7 ms ", "7\tms", "7 msec", "1d",
                                 "7 MS", "s 7", "+7 ms", "0x7 ms", "7,5 ms", "1.5.2 s"})
    assert_false(parse_duration(text).has_value());
}

void a_duration_is_finite_whole_and_not_negative(void**) {
  for (const char* const text :
       {"-7 ms", "-1s", "nan s", "nans", "inf s", "infs", "1e3 ms", "1e300h", "1e30 s", "0.5 ns", "1.0005 us",
        "0.0001us", "9000000001 s", "99999999999999 s", "2500001 h"})
    assert_false(parse_duration(text).has_value());
}

void only_what_is_seen_is_read(void**) {
  assert_true(parse_duration(std::string_view{"7 ms"}.substr(0, 4)) == Duration{7'000'000});
  assert_false(parse_duration(std::string_view{"7 ms"}.substr(0, 3)).has_value());
  assert_true(parse_duration(std::string_view{"17 s"}.substr(1)) == std::chrono::seconds{7});
}

void sizes_are_read_likewise(void**) {
  assert_int_equal(parse_size("8 MiB").value_or(0), 8U << 20);
  assert_int_equal(parse_size("1.5 KiB").value_or(0), 1536);
  assert_int_equal(parse_size("512 B").value_or(0), 512);
  assert_int_equal(parse_size("2GiB").value_or(0), std::uint64_t{2} << 30);
  for (const char* const text : {"", "8", "8 MB", "8 mib", "8  MiB", "-1 B", "0.5 B", "1.0001 KiB", "nan B",
                                 "inf GiB", "1e3 B", "9000000000 GiB"})
    assert_false(parse_size(text).has_value());
}

}  // namespace
}  // namespace flexrf::quantity_text_test

int main() {
  using namespace flexrf::quantity_text_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(durations_have_three_digits_and_their_unit),
      cmocka_unit_test(sizes_too),
      cmocka_unit_test(hashes_have_all_their_digits),
      cmocka_unit_test(durations_are_read_in_each_unit),
      cmocka_unit_test(what_is_no_duration_is_nothing),
      cmocka_unit_test(a_duration_is_finite_whole_and_not_negative),
      cmocka_unit_test(only_what_is_seen_is_read),
      cmocka_unit_test(sizes_are_read_likewise),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
