// Joints that slide, and joints that turn without end: a SCARA robot, from its URDF on.
#include <cmath>
#include <numbers>
#include <random>

#include "motion/joint_trajectory.hpp"
#include "motion/kinematics.hpp"
#include "scara.hpp"
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;
using Eigen::Isometry3d;
using Eigen::Vector3d;

static_assert(scara.joint_count == 4);
static_assert(scara.joints[1].kind == JointKind::revolute);
static_assert(scara.joints[2].kind == JointKind::prismatic);
static_assert(scara.joints[3].kind == JointKind::continuous);

JointVector at(double shoulder, double elbow, double lift, double roll) {
  JointVector joints = JointVector::Zero();
  joints.head<4>() << shoulder, elbow, lift, roll;
  return joints;
}

JointVector anywhere(std::mt19937_64& random) {
  const auto from = [&random](double low, double high) {
    return std::uniform_real_distribution(low, high)(random);
  };
  return at(from(-2, 2), from(0.3, 2.2), from(0.01, 0.19), from(-20, 20));
}

// Known by hand from the URDF's lengths.
void forward(void**) {
  const Isometry3d zero = forward_kinematics(scara, JointVector::Zero());
  assert_true((zero.translation() - Vector3d(0.6, 0, 0.35)).norm() < 1e-12);
  const Isometry3d low = forward_kinematics(scara, at(std::numbers::pi / 2, 0, 0.2, 0));
  assert_true((low.translation() - Vector3d(0, 0.6, 0.15)).norm() < 1e-12);
  // The tool points down; a turn of its own turns it the other way round seen from above.
  const Isometry3d turned = forward_kinematics(scara, at(0, 0, 0, std::numbers::pi / 2));
  assert_true((turned.linear().col(2) + Vector3d::UnitZ()).norm() < 1e-12);
  assert_true((turned.linear().col(0) + Vector3d::UnitY()).norm() < 1e-12);
}

bool jacobian_is_the_derivative() {
  std::mt19937_64 random(1);
  constexpr double h = 1e-6;
  for (int n = 0; n < 200; ++n) {
    const JointVector joints = anywhere(random);
    const JacobianMatrix jacobian = geometric_jacobian(scara, joints);
    for (int i = 0; i < 4; ++i) {
      JointVector more = joints, less = joints;
      more[i] += h;
      less[i] -= h;
      const Isometry3d a = forward_kinematics(scara, less);
      const Isometry3d b = forward_kinematics(scara, more);
      const Eigen::AngleAxisd turn(b.linear() * a.linear().transpose());
      if ((jacobian.block<3, 1>(0, i) - (b.translation() - a.translation()) / (2 * h)).norm() > 1e-6)
        return false;
      if ((jacobian.block<3, 1>(3, i) - turn.angle() * turn.axis() / (2 * h)).norm() > 1e-5) return false;
    }
  }
  return true;
}
void jacobian(void**) {
  assert_true(jacobian_is_the_derivative());
}

// Of four joints, which cannot take any orientation: what they can reach they find.
int found_of(int cases) {
  std::mt19937_64 random(2);
  int found = 0;
  for (int n = 0; n < cases; ++n) {
    const JointVector joints = anywhere(random);
    JointVector seed = joints;
    seed[0] += 0.2;
    seed[1] -= 0.2;
    seed[2] = 0.1;
    seed[3] += 0.5;
    const Isometry3d target = forward_kinematics(scara, joints);
    const InverseResult result = inverse_kinematics(scara, target, within_limits(scara, seed));
    const double off = (forward_kinematics(scara, result.joints).matrix() - target.matrix()).norm();
    // The turn nearest to the seed, however many there were.
    if (result.outcome == InverseOutcome::converged && off < 1e-5 &&
        std::abs(result.joints[3] - joints[3]) < 1)
      ++found;
  }
  return found;
}
void inverse(void**) {
  const int found = found_of(500);
  print_message("%d of 500 found\n", found);
  assert_true(found >= 490);
}

void what_lies_below_its_stroke_is_at_the_limit(void**) {
  Isometry3d target = forward_kinematics(scara, home_position(scara));
  target.translation().z() -= 0.15;
  const InverseResult result = inverse_kinematics(scara, target, home_position(scara));
  assert_true(result.outcome == InverseOutcome::at_limit);
  assert_true(result.joints[2] == 0.2);
  // It is not tilted to get there.
  target = forward_kinematics(scara, home_position(scara));
  target.linear() = target.linear() * Eigen::AngleAxisd(0.3, Vector3d::UnitX());
  assert_true(inverse_kinematics(scara, target, home_position(scara)).outcome != InverseOutcome::converged);
}

void limits_are_each_joints_own(void**) {
  const JointVector kept = within_limits(scara, at(0, 0, 0.3, 1000));
  assert_true(kept[2] == 0.2 && kept[3] == 1000);
  const double wanted[] = {0, 0, 0.3, 0};
  const Restraint restraint = restraint_of(scara, wanted);
  assert_string_equal(restraint.reason, "joint 3 is kept to its limit");
  assert_true(restraint.given == 0.2);
}

// 0.2 m at 1.1 m/s and a quarter turn at 20 rad/s: the one that takes longest leads, in its own unit.
void motions_keep_to_each_joints_limits(void**) {
  JointTrajectory trajectory;
  assert_true(trajectory.plan(scara, at(0, 0, 0, 0), at(0, 0, 0.2, 1.57)));
  double fastest = 0;
  for (double time = 0; time < trajectory.end_time(); time += 1e-3) {
    const JointSample sample = trajectory.at(time);
    fastest = std::max(fastest, sample.velocity[2]);
    assert_true(sample.velocity[2] <= 1.1 + 1e-9 && std::abs(sample.acceleration[2]) <= 12 + 1e-9);
    assert_true(sample.velocity[3] <= 20 && std::abs(sample.acceleration[3]) <= 100 + 1e-9);
  }
  assert_true(fastest > 0.9);
  assert_true(trajectory.at(trajectory.end_time()).position[2] == 0.2);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(forward),
      cmocka_unit_test(jacobian),
      cmocka_unit_test(inverse),
      cmocka_unit_test(what_lies_below_its_stroke_is_at_the_limit),
      cmocka_unit_test(limits_are_each_joints_own),
      cmocka_unit_test(motions_keep_to_each_joints_limits),
  };
  return cmocka_run_group_tests_name("joints that slide", tests, nullptr, nullptr);
}
