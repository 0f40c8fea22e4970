// Values of options: what a number and a duration have to be, and what was given.
#include "runtime/core/option.hpp"

#include <cstring>

#include "tests/cmocka.hpp"

namespace flexrf::option_test {
namespace {

constexpr Option force{.name = "--force",
                       .kind = OptionKind::number,
                       .value = "NUMBER",
                       .summary = "",
                       .unit = "N",
                       .least = -1.5,
                       .most = 20};
constexpr Option share{.name = "--share", .kind = OptionKind::number, .value = "NUMBER", .summary = ""};
constexpr Option limit{.name = "--limit", .kind = OptionKind::duration, .value = "DURATION", .summary = ""};
constexpr Option loud{.name = "--loud", .kind = OptionKind::flag, .value = nullptr, .summary = ""};

void check_refused(const Option& option, const char* value, const char* cause) {
  const Status status = check_value(option, value);
  assert_int_equal(status.code(), StatusCode::invalid_argument);
  assert_string_equal(status.cause(), cause);
}

void numbers_are_whole_words_within_their_range(void**) {
  for (const char* const value : {"0", "-1.5", "2e1", "19.99"})
    assert_true(check_value(force, value).is_ok());
  check_refused(force, "20.1", "--force 20.1: give a number from -1.5 to 20, in N");
  check_refused(force, "3N", "--force 3N: give a number from -1.5 to 20, in N");
  assert_true(check_value(share, "1e300").is_ok());
  for (const char* const value : {"much", "1 2", "nan", "inf", "1e999", "-"})
    assert_false(check_value(share, value).is_ok());
  check_refused(share, "nan", "--share nan: give a number");
}

void durations_have_their_unit(void**) {
  for (const char* const value : {"60s", "0.5ms", "1min", "2h", "3us", "7ns"})
    assert_true(check_value(limit, value).is_ok());
  for (const char* const value :
       {"0s", "-1s", "5 s", "s", "1d", "1e300h", "1e3s", "0.0001us", "1.5ns", "nans"})
    assert_false(check_value(limit, value).is_ok());
  check_refused(limit, "5", "--limit 5: give a duration with its unit (ns, us, ms, s, min, h), as `60s`");
}

void what_was_given_last_counts(void**) {
  const GivenOption given[] = {{&force, "1"}, {&limit, "250ms"}, {&loud, nullptr}, {&force, "2.5"}};
  const OptionValues values{given};
  assert_true(values.number("--force") == 2.5);
  assert_string_equal(values.text("--force"), "2.5");
  assert_true(values.duration("--limit") == Duration{250'000'000});
  assert_true(values.has("--loud"));
}

void what_was_not_given_is_nothing(void**) {
  const OptionValues values;
  assert_false(values.has("--loud"));
  assert_null(values.text("--force"));
  assert_string_equal(values.text("--force", "none"), "none");
  assert_false(values.number("--force").has_value());
  assert_false(values.duration("--limit").has_value());
}

}  // namespace
}  // namespace flexrf::option_test

int main() {
  using namespace flexrf::option_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(numbers_are_whole_words_within_their_range),
      cmocka_unit_test(durations_have_their_unit),
      cmocka_unit_test(what_was_given_last_counts),
      cmocka_unit_test(what_was_not_given_is_nothing),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
