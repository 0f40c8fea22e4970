#include "units/arm_motion/key_motion.hpp"

#include <cmath>

#include "motion/pose_conversion.hpp"
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;

constexpr double step = 0.01;
constexpr double turn = 0.1;

// Where the key takes a pose at (1, 2, 3) that is not turned.
Eigen::Isometry3d after(const KeyEvent& event) {
  Pose pose{};
  pose.position = {1, 2, 3};
  if (!move_by_key(pose, event, step, turn)) pose.position = {NAN, NAN, NAN};
  return to_isometry(pose);
}

bool moves(char key, double x, double y, double z) {
  const Eigen::Isometry3d pose = after({Key::character, static_cast<std::uint32_t>(key)});
  return (pose.translation() - Eigen::Vector3d(1 + x, 2 + y, 3 + z)).norm() < 1e-12 &&
         pose.linear().isIdentity(1e-12);
}

bool turns(const KeyEvent& event, const Eigen::Vector3d& axis) {
  const Eigen::Isometry3d pose = after(event);
  return (pose.translation() - Eigen::Vector3d(1, 2, 3)).norm() < 1e-12 &&
         (pose.linear() - Eigen::AngleAxisd(turn, axis).toRotationMatrix()).norm() < 1e-12;
}

void letters_move(void**) {
  assert_true(moves('w', step, 0, 0));
  assert_true(moves('s', -step, 0, 0));
  assert_true(moves('a', 0, step, 0));
  assert_true(moves('d', 0, -step, 0));
  assert_true(moves('q', 0, 0, step));
  assert_true(moves('e', 0, 0, -step));
}

void arrows_turn(void**) {
  assert_true(turns({Key::up, 0}, Eigen::Vector3d::UnitY()));
  assert_true(turns({Key::down, 0}, -Eigen::Vector3d::UnitY()));
  assert_true(turns({Key::left, 0}, Eigen::Vector3d::UnitZ()));
  assert_true(turns({Key::right, 0}, -Eigen::Vector3d::UnitZ()));
  assert_true(turns({Key::character, 'u'}, Eigen::Vector3d::UnitX()));
  assert_true(turns({Key::character, 'o'}, -Eigen::Vector3d::UnitX()));
}

void other_keys_do_nothing(void**) {
  Pose pose{};
  assert_false(move_by_key(pose, {Key::character, 'x'}, step, turn));
  assert_false(move_by_key(pose, {Key::enter, 0}, step, turn));
  assert_false(move_by_key(pose, {Key::none, 0}, step, turn));
  assert_true(pose.position == (Pose{}).position);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(letters_move),
      cmocka_unit_test(arrows_turn),
      cmocka_unit_test(other_keys_do_nothing),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
