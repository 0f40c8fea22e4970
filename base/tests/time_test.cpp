// Durations from and to seconds.
#include "base/time.hpp"

#include <limits>

#include "tests/cmocka.hpp"

namespace flexrf::time_test {
namespace {

void to_the_nearest_nanosecond(void**) {
  assert_int_equal(duration_of(0.3).count(), 300'000'000);
  assert_int_equal(duration_of(1e-9).count(), 1);
  assert_int_equal(duration_of(0.4e-9).count(), 0);
  assert_int_equal(duration_of(-0.007).count(), -7'000'000);
  assert_int_equal(duration_of(86400.0).count(), 86'400'000'000'000);
}

void there_and_back(void**) {
  for (const Duration duration :
       {Duration{1}, Duration{7'000'000}, Duration{1'234'567'890'123}, -Duration{5}})
    assert_true(duration_of(seconds(duration)) == duration);
}

void what_does_not_fit_is_the_most_there_is(void**) {
  assert_true(duration_of(1e10) == Duration::max());
  assert_true(duration_of(-1e300) == Duration::min());
  assert_true(duration_of(std::numeric_limits<double>::infinity()) == Duration::max());
  assert_true(duration_of(std::numeric_limits<double>::quiet_NaN()) == Duration{});
}

}  // namespace
}  // namespace flexrf::time_test

int main() {
  using namespace flexrf::time_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(to_the_nearest_nanosecond),
      cmocka_unit_test(there_and_back),
      cmocka_unit_test(what_does_not_fit_is_the_most_there_is),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
