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

// [joystick-tracker-6]
void one_that_comes_is_at_rest_until_it_is_moved_or_pressed_anew(void**) {
  JoystickTracker tracker;
  tracker.deflect(1, 0.5);  // while it was away
  tracker.press(2);
  tracker.appear();
  assert_true(tracker.state().present);
  assert_true(tracker.state().axes[1] == 0 && tracker.state().buttons == 0 &&
              tracker.state().presses[2] == 0);
  tracker.deflect(1, 0.5);
  tracker.press(2);
  assert_true(tracker.state().axes[1] == 0.5 && tracker.state().buttons == 4);
  tracker.appear();  // another one, in the place of the first
  assert_true(tracker.state().axes[1] == 0 && tracker.state().buttons == 0);
}

// [joystick-tracker-7]
void what_has_no_place_is_passed_over(void**) {
  JoystickTracker tracker;
  tracker.appear();
  const JoystickState before = tracker.state();
  tracker.deflect(before.axes.size(), 1);
  tracker.press(before.presses.size());
  tracker.let_go(before.presses.size());
  tracker.press(before.presses.size());
  assert_int_equal(tracker.state().buttons, 0);
  assert_true(tracker.state().axes == before.axes && tracker.state().presses == before.presses);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(ends_are_one_and_the_centre_is_zero),
      cmocka_unit_test(the_dead_zone_is_zero_and_nothing_jumps_at_its_edge),
      cmocka_unit_test(the_larger_dead_zone_counts),
      cmocka_unit_test(a_range_that_makes_no_sense_is_zero),
      cmocka_unit_test(one_that_comes_is_at_rest_until_it_is_moved_or_pressed_anew),
      cmocka_unit_test(what_has_no_place_is_passed_over),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
