// Where the tool was at a time: between the entries of a slot's history, and why it is not known.
#include "motion/pose_history.hpp"

#include <cmath>
#include <numbers>

#include "motion/pose_conversion.hpp"
#include "tests/cmocka.hpp"
#include "types/joint_state.hpp"

namespace {

using namespace flexrf;

Time at(std::int64_t milliseconds) {
  return Time{std::chrono::milliseconds(milliseconds)};
}

/// A slot that keeps four entries, and an input of it.
template <class T>
struct Past {
  explicit Past(bool kept = true) : slot({}, kept ? &history : nullptr) {
    output.connect(&context, &slot.control());
    input.connect(&context, InputBinding{&reader, 1, Duration{}, nullptr});
  }
  HistoryMemory<T, 4> memory{};
  History history{descriptor_of<T>, memory.words, 4};
  Slot<T, 1> slot;
  SlotReader reader{&slot.control()};
  StepContext context{1, at(1000)};
  Output<T> output;
  Input<T> input;
};

Pose turned(double x, double angle) {
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.translation().x() = x;
  frame.linear() = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return to_pose(frame);
}

bool is_near(const Pose& pose, double x, double angle) {
  const Eigen::Isometry3d wanted = to_isometry(turned(x, angle));
  return (to_isometry(pose).matrix() - wanted.matrix()).norm() < 1e-12;
}

void poses_are_interpolated(void**) {
  Past<Pose> past;
  past.output.publish(turned(0, 0), at(100));
  past.output.publish(turned(1, 1), at(110));
  past.output.publish(turned(1, 1), at(120));
  Pose pose{};
  assert_int_equal(value_at(past.input, at(100), pose), NullReason::none);
  assert_true(is_near(pose, 0, 0));
  assert_int_equal(value_at(past.input, at(105), pose), NullReason::none);
  assert_true(is_near(pose, 0.5, 0.5));
  assert_int_equal(value_at(past.input, at(110) - std::chrono::milliseconds(1), pose), NullReason::none);
  assert_true(is_near(pose, 0.9, 0.9));
  assert_int_equal(value_at(past.input, at(117), pose), NullReason::none);
  assert_true(is_near(pose, 1, 1));
  assert_int_equal(value_at(past.input, at(120), pose), NullReason::none);
}

// Two quaternions that mean nearly the same, of opposite signs.
void orientations_go_the_shorter_way(void**) {
  Pose from = turned(0, 0.1);
  Pose to = turned(0, 0.3);
  to.orientation_map() *= -1;
  assert_true(is_near(interpolated(from, to, 0.5), 0, 0.2));
  // All zero is not rotated.
  from.orientation = {};
  assert_true(is_near(interpolated(from, to, 0.5), 0, 0.15));
  assert_true(is_near(interpolated(turned(0, -1.5), turned(2, 1.5), 0.25), 0.5, -0.75));
}

void what_is_not_kept_is_null_with_its_reason(void**) {
  Past<Pose> past;
  Pose pose = turned(7, 0);
  assert_int_equal(value_at(past.input, at(100), pose), NullReason::nothing_yet);
  past.output.publish(turned(0, 0), at(100));
  assert_int_equal(value_at(past.input, at(99), pose), NullReason::nothing_yet);   // before the first
  assert_int_equal(value_at(past.input, at(101), pose), NullReason::nothing_yet);  // after the last
  for (int n = 1; n < 6; ++n) past.output.publish(turned(n, 0), at(100 + 10 * n));
  assert_int_equal(value_at(past.input, at(119), pose), NullReason::no_longer_kept);
  assert_int_equal(value_at(past.input, at(151), pose), NullReason::nothing_yet);
  assert_true(is_near(pose, 7, 0));  // as it was
  assert_int_equal(value_at(past.input, at(125), pose), NullReason::none);
  assert_true(is_near(pose, 2.5, 0));

  Past<Pose> without(false);
  without.output.publish(turned(0, 0), at(100));
  assert_int_equal(value_at(without.input, at(100), pose), NullReason::not_registered);
  const Input<Pose> unconnected;
  assert_int_equal(value_at(unconnected, at(100), pose), NullReason::not_registered);
}

void joints_are_interpolated(void**) {
  Past<JointState> past;
  JointState state{};
  past.output.publish(state, at(100));
  state.position[2] = 0.4;
  state.velocity[2] = -2;
  past.output.publish(state, at(108));
  JointState between{};
  assert_int_equal(value_at(past.input, at(102), between), NullReason::none);
  assert_true(std::abs(between.position[2] - 0.1) < 1e-15 && std::abs(between.velocity[2] + 0.5) < 1e-15);
  assert_true(between.position[0] == 0);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(poses_are_interpolated),
      cmocka_unit_test(orientations_go_the_shorter_way),
      cmocka_unit_test(what_is_not_kept_is_null_with_its_reason),
      cmocka_unit_test(joints_are_interpolated),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
