// Fingers in memory, as a scene leads them; what else they do the conformance suite sees with the mock.
#include "hal/gripper/interface/finger_control.hpp"

#include <cmath>
#include <string_view>

#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;
using std::chrono::milliseconds;

// Each case runs in here, so that a failing assertion jumps over no destructor.
template <bool (*Run)()>
void judged(void**) {
  assert_true(Run());
}

FingerControl opened() {
  FingerControl control;
  control.begin({.whose = "the test's", .open_width = 0.08, .speed = 0.1, .travel_timeout = 2});
  return control;
}

void advance(FingerControl& control, int cycles, double width) {
  for (int i = 0; i < cycles; ++i) {
    meet_width(control.fingers(), width);
    control.advance(milliseconds(10));
  }
}

bool they_stop_where_the_scene_says() {
  FingerControl control = opened();
  control.go({.opening = 0});
  advance(control, 10, 0.031);
  // What lies between them turns, and takes less.
  if (control.fingers().opening() < 0.031 || !control.known().moving) return false;
  advance(control, 60, 0.030);
  return control.fingers().opening() == 0.030 && control.known().object == GripperObject::gripped &&
         !control.known().moving;
}

bool what_is_gone_is_lost() {
  FingerControl control = opened();
  control.go({.opening = 0});
  advance(control, 70, 0.030);
  if (control.known().object != GripperObject::gripped) return false;
  advance(control, 60, 0);
  return control.known().object == GripperObject::lost && control.fingers().opening() == 0;
}

bool without_anything_between_they_close() {
  FingerControl control = opened();
  control.go({.opening = 0, .speed = 0.05});
  advance(control, 100, 0);
  if (std::abs(control.fingers().opening() - 0.03) > 1e-9) return false;
  advance(control, 100, 0);
  return control.known().object == GripperObject::none && control.fingers().opening() == 0;
}

bool stuck_fingers_are_told_in_its_own_words() {
  FingerControl control = opened();
  control.set_fault(FingerControl::Fault::stuck);
  control.go({.opening = 0});
  advance(control, 250, 0);
  return control.trouble().code() == StatusCode::timeout &&
         std::string_view(control.trouble().cause()).starts_with("the test's fingers");
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(judged<they_stop_where_the_scene_says>),
      cmocka_unit_test(judged<what_is_gone_is_lost>),
      cmocka_unit_test(judged<without_anything_between_they_close>),
      cmocka_unit_test(judged<stuck_fingers_are_told_in_its_own_words>),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
