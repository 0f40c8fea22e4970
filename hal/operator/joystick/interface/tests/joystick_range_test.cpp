#include <cmath>

#include "hal/operator/joystick/interface/joystick_tracker.hpp"
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;

bool near(double a, double b) {
  return std::abs(a - b) < 1e-12;
}

// [joystick-tracker-1]
void ends_are_one_and_the_centre_is_zero(void**) {
  const JoystickRange range{0, 255, 0};
  assert_true(near(deflection(0, range, 0.1), -1));
  assert_true(near(deflection(255, range, 0.1), 1));
  assert_true(near(deflection(127.5, range, 0), 0));
  assert_true(near(deflection(300, range, 0.1), 1));  // beyond what it says of itself
  assert_true(near(deflection(-7, range, 0.1), -1));
}

// [joystick-tracker-3]
void the_dead_zone_is_zero_and_nothing_jumps_at_its_edge(void**) {
  const JoystickRange range{-1000, 1000, 0};
  for (const double value : {-200.0, -1.0, 0.0, 199.0, 200.0})
    assert_true(deflection(value, range, 0.2) == 0);
  assert_true(near(deflection(208, range, 0.2), 0.01));
  assert_true(near(deflection(-208, range, 0.2), -0.01));
  assert_true(near(deflection(600, range, 0.2), 0.5));
}

// [joystick-tracker-2]
void the_larger_dead_zone_counts(void**) {
  const JoystickRange range{-1000, 1000, 300};
  assert_true(deflection(299, range, 0.1) == 0);
  assert_true(deflection(399, range, 0.4) == 0);
  assert_true(near(deflection(1000, range, 0.4), 1));
  // An axis that is flat everywhere, as it says, is not taken at its word.
  assert_true(near(deflection(1000, {-1000, 1000, 5000}, 0.1), 1));
}

// [joystick-tracker-4]
void a_range_that_makes_no_sense_is_zero(void**) {
  assert_true(deflection(5, {3, 3, 0}, 0.1) == 0);
  assert_true(deflection(5, {7, 3, 0}, 0.1) == 0);
  assert_true(deflection(NAN, {0, 255, 0}, 0.1) == 0);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(ends_are_one_and_the_centre_is_zero),
      cmocka_unit_test(the_dead_zone_is_zero_and_nothing_jumps_at_its_edge),
      cmocka_unit_test(the_larger_dead_zone_counts),
      cmocka_unit_test(a_range_that_makes_no_sense_is_zero),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
