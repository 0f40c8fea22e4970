#include "hal/operator/pointer/interface/pointer_tracker.hpp"

#include <algorithm>

#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;

// [pointer-tracker-2]
void what_was_down_before_it_came_counts_when_it_is_pressed_anew(void**) {
  PointerTracker tracker;
  tracker.press(2);  // while it was away
  tracker.appear();
  assert_true(tracker.state().present);
  assert_int_equal(tracker.state().buttons, 0);
  assert_int_equal(tracker.state().presses[2], 0);
  tracker.press(2);
  assert_int_equal(tracker.state().buttons, 4);
  tracker.appear();  // another one, in the place of the first
  assert_int_equal(tracker.state().buttons, 0);
  tracker.press(2);
  assert_int_equal(tracker.state().buttons, 4);
  assert_int_equal(tracker.state().presses[2], 2);
}

// [pointer-tracker-3]
void buttons_without_a_place_are_passed_over(void**) {
  PointerTracker tracker;
  tracker.appear();
  for (const std::size_t button : {8, 9, 31, 1000}) {
    tracker.press(button);
    tracker.let_go(button);
    tracker.press(button);
  }
  assert_int_equal(tracker.state().buttons, 0);
  const auto& presses = tracker.state().presses;
  assert_int_equal(std::count(presses.begin(), presses.end(), 0U), 8);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(what_was_down_before_it_came_counts_when_it_is_pressed_anew),
      cmocka_unit_test(buttons_without_a_place_are_passed_over),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
