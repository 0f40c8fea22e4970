#include "hal/operator/keyboard/interface/key_tracker.hpp"

#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;

constexpr KeyEvent letter{.key = Key::character, .character = 'w'};

// [key-tracker-2]
void what_was_down_before_it_came_counts_when_it_is_pressed_anew(void**) {
  KeyTracker tracker;
  tracker.press(letter);  // while it was away
  tracker.appear();
  assert_true(tracker.held().present);
  assert_int_equal(tracker.held().count, 0);
  tracker.press(letter);
  assert_int_equal(tracker.held().count, 1);
  tracker.appear();  // another one, in the place of the first
  assert_int_equal(tracker.held().count, 0);
  tracker.press(letter);
  assert_true(tracker.held().count == 1 && is_held(tracker.held(), letter));
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(what_was_down_before_it_came_counts_when_it_is_pressed_anew)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
