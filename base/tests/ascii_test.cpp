#include "base/ascii.hpp"

#include "tests/cmocka.hpp"

namespace flexrf::ascii_test {
namespace {

void letters_of_ascii(void**) {
  assert_int_equal(lower_case('A'), 'a');
  assert_int_equal(lower_case('Z'), 'z');
  for (const char other : {'@', '[', 'a', '0', '\xC4'}) assert_int_equal(lower_case(other), other);
}

void comparison(void**) {
  assert_true(equal_without_case("LocalHost", "localhost"));
  assert_true(equal_without_case("", ""));
  assert_false(equal_without_case("local", "localhost"));
  assert_false(equal_without_case("localhost", "local"));
  assert_false(equal_without_case("\xC4", "\xE4"));  // of no one encoding
}

void hexadecimal_digits(void**) {
  assert_int_equal(hexadecimal_digit('0'), 0);
  assert_int_equal(hexadecimal_digit('9'), 9);
  assert_int_equal(hexadecimal_digit('a'), 10);
  assert_int_equal(hexadecimal_digit('F'), 15);
  for (const char other : {'/', ':', '@', 'G', '`', 'g', '\xC4', '\0'})
    assert_int_equal(hexadecimal_digit(other), -1);
}

}  // namespace
}  // namespace flexrf::ascii_test

int main() {
  using namespace flexrf::ascii_test;
  const CMUnitTest tests[] = {cmocka_unit_test(letters_of_ascii), cmocka_unit_test(comparison),
                              cmocka_unit_test(hexadecimal_digits)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
