// The allocation guard watches the library as it ships; Eigen's own assertions are on under the sanitizers.
#include "motion/kinematics.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "runtime/realtime/realtime_scope.hpp"
#include "six_axis.hpp"
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;
using Eigen::Isometry3d;

#ifdef FLEXRF_SANITIZER
constexpr int random_cases = 200;  // a sanitizer makes them many times slower
#else
constexpr int random_cases = 3000;
#endif
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

JointVector random_posture(std::mt19937_64& random, double part = 1.0) {
  JointVector joints = JointVector::Zero();
  for (std::size_t i = 0; i < six_axis.joint_count; ++i) {
    joints[static_cast<Eigen::Index>(i)] =
        part * std::uniform_real_distribution(six_axis.joints[i].lower, six_axis.joints[i].upper)(random);
  }
  return joints;
}

double distance(const Isometry3d& a, const Isometry3d& b) {
  return (a.matrix() - b.matrix()).norm();
}

bool sane(const InverseResult& result) {
  return result.joints.allFinite() && result.joints == within_limits(six_axis, result.joints) &&
         std::isfinite(result.position_error) && std::isfinite(result.orientation_error) &&
         std::isfinite(result.singular_value);
}

Isometry3d at_home(double x, double y, double z) {
  Isometry3d pose = forward_kinematics(six_axis, home_position(six_axis));
  pose.translation() += Eigen::Vector3d(x, y, z);
  return pose;
}

// Known by hand from the URDF's lengths.
void test_forward_at_zero_and_home(void**) {
  const Isometry3d zero = forward_kinematics(six_axis, JointVector::Zero());
  assert_true(
      (zero.translation() - Eigen::Vector3d(0.16 + 0.18 + 0.42 + 0.10, 0, 0.48 + 0.64 + 0.04)).norm() <
      1e-12);
  assert_true((zero.linear().col(2) - Eigen::Vector3d::UnitX()).norm() < 1e-12);
  const Isometry3d home = forward_kinematics(six_axis, home_position(six_axis));
  assert_true((home.translation() - Eigen::Vector3d(0.76, 0, 1.16 - 0.10)).norm() < 1e-12);
  assert_true((home.linear().col(2) + Eigen::Vector3d::UnitZ()).norm() < 1e-12);  // the tool points down
  JointVector turned = home_position(six_axis);
  turned[0] = std::numbers::pi / 2;
  const Isometry3d left = forward_kinematics(six_axis, turned);
  assert_true((left.translation() - Eigen::Vector3d(0, 0.76, 1.06)).norm() < 1e-12);
}

bool jacobian_is_the_derivative() {
  std::mt19937_64 random(1);
  constexpr double h = 1e-6;
  for (int n = 0; n < 200; ++n) {
    const JointVector joints = random_posture(random);
    const JacobianMatrix jacobian = geometric_jacobian(six_axis, joints);
    for (int i = 0; i < static_cast<int>(max_joints); ++i) {
      JointVector more = joints, less = joints;
      more[i] += h;
      less[i] -= h;
      const Isometry3d a = forward_kinematics(six_axis, less);
      const Isometry3d b = forward_kinematics(six_axis, more);
      const Eigen::AngleAxisd turn(b.linear() * a.linear().transpose());
      const Eigen::Vector3d linear = (b.translation() - a.translation()) / (2 * h);
      const Eigen::Vector3d angular = turn.angle() * turn.axis() / (2 * h);
      if ((jacobian.block<3, 1>(0, i) - linear).norm() > 1e-6) return false;
      if ((jacobian.block<3, 1>(3, i) - angular).norm() > 1e-5) return false;
    }
  }
  return true;
}

// A pose of the arm, from a seed some way off: found nearly always, and never claimed when not there.
bool inverse_finds_poses_of_the_arm() {
  std::mt19937_64 random(2);
  int converged = 0;
  constexpr int cases = random_cases;
  for (int n = 0; n < cases; ++n) {
    const JointVector joints = random_posture(random, 0.9);
    JointVector seed = joints;
    for (int i = 0; i < 6; ++i) seed[i] += std::uniform_real_distribution(-0.4, 0.4)(random);
    const Isometry3d target = forward_kinematics(six_axis, joints);
    AllocationCounter allocations{0};
    const InverseResult result = [&] {
      const RealtimeScope scope(allocations);
      return inverse_kinematics(six_axis, target, within_limits(six_axis, seed));
    }();
    if (allocations != 0 || !sane(result)) return false;
    const double off = distance(forward_kinematics(six_axis, result.joints), target);
    const bool claimed = result.outcome == InverseOutcome::converged;
    if (claimed ? off > 1e-5 : off < 5e-7) return false;
    if (claimed) ++converged;
  }
  print_message("%d of %d converged\n", converged, cases);
  return converged >= cases * 98 / 100;
}

// A small motion of the tool is a small motion of the joints: no elbow flips.
bool small_motions_stay_small() {
  std::mt19937_64 random(3);
  int tried = 0;
  for (int n = 0; n < random_cases; ++n) {
    const JointVector seed = random_posture(random, 0.9);
    if (smallest_singular_value(geometric_jacobian(six_axis, seed)) < 0.1) continue;
    ++tried;
    Isometry3d target = forward_kinematics(six_axis, seed);
    target.translation() += 0.01 * Eigen::Vector3d::Random().normalized();
    const InverseResult result = inverse_kinematics(six_axis, target, seed);
    if (result.outcome == InverseOutcome::converged && (result.joints - seed).norm() > 0.15) return false;
    if (result.outcome != InverseOutcome::converged && result.outcome != InverseOutcome::at_limit)
      return false;
  }
  return tried > random_cases / 6;
}

// Many centimetres at once, as when a line of keys was typed while the arm moved.
void test_inverse_from_home(void**) {
  for (const Eigen::Vector3d& offset : {Eigen::Vector3d(0.04, -0.03, 0), Eigen::Vector3d(0.3, 0.3, -0.3),
                                        Eigen::Vector3d(-0.3, 0.2, 0.1), Eigen::Vector3d(0, 0, 0)}) {
    const Isometry3d target = at_home(offset[0], offset[1], offset[2]);
    const InverseResult result = inverse_kinematics(six_axis, target, home_position(six_axis));
    assert_int_equal(result.outcome, InverseOutcome::converged);
    assert_true(distance(forward_kinematics(six_axis, result.joints), target) < 1e-5);
  }
}

void test_out_of_reach(void**) {
  for (const Isometry3d& target : {at_home(2, 0, 0), at_home(0, 0, 3), at_home(500, -500, 500)}) {
    const InverseResult result = inverse_kinematics(six_axis, target, home_position(six_axis));
    assert_true(sane(result));
    assert_true(result.outcome == InverseOutcome::unreachable || result.outcome == InverseOutcome::at_limit ||
                result.outcome == InverseOutcome::singular);
    assert_true(result.position_error > 0.5);
  }
  const InverseResult straight = inverse_kinematics(six_axis, at_home(1.2, 0, -0.4), home_position(six_axis));
  assert_int_equal(straight.outcome, InverseOutcome::unreachable);
}

// The wrist straight (axes 4 and 6 in line) has lost a rotation; from there the descent must find its way.
void test_out_of_the_singular_wrist(void**) {
  const JointVector straight = JointVector::Zero();
  assert_true(smallest_singular_value(geometric_jacobian(six_axis, straight)) < 1e-7);
  Isometry3d target = forward_kinematics(six_axis, straight);
  target.translation() += Eigen::Vector3d(-0.1, 0.05, -0.1);
  target.linear() =
      Eigen::AngleAxisd(0.2, Eigen::Vector3d(1, 1, 1).normalized()).toRotationMatrix() * target.linear();
  const InverseResult result = inverse_kinematics(six_axis, target, straight);
  assert_true(sane(result));
  assert_int_equal(result.outcome, InverseOutcome::converged);
}

// A turn of the base by more than axis 1 can do, the wrist being unable to make up for it.
void test_a_limit_is_named(void**) {
  KinematicChain narrow = six_axis;
  narrow.joints[0].lower = -0.1;
  narrow.joints[0].upper = 0.1;
  narrow.joints[3].lower = -0.05;
  narrow.joints[3].upper = 0.05;
  JointVector turned = home_position(six_axis);
  turned[0] = 0.6;
  const Isometry3d target = forward_kinematics(six_axis, turned);
  const InverseResult result = inverse_kinematics(narrow, target, home_position(six_axis));
  assert_int_equal(result.outcome, InverseOutcome::at_limit);
  assert_true(result.joints == within_limits(narrow, result.joints));
}

void test_nonsense_is_refused(void**) {
  const JointVector home = home_position(six_axis);
  Isometry3d target = at_home(not_a_number, 0, 0);
  assert_int_equal(inverse_kinematics(six_axis, target, home).outcome, InverseOutcome::invalid);
  assert_true(inverse_kinematics(six_axis, target, home).joints == home);
  target = at_home(std::numeric_limits<double>::infinity(), 0, 0);
  assert_int_equal(inverse_kinematics(six_axis, target, home).outcome, InverseOutcome::invalid);
  target = at_home(1e300, 0, 0);
  assert_int_equal(inverse_kinematics(six_axis, target, home).outcome, InverseOutcome::invalid);
  target = at_home(0, 0, 0);
  target.linear() *= 2;
  assert_int_equal(inverse_kinematics(six_axis, target, home).outcome, InverseOutcome::invalid);
  target = at_home(0, 0, 0);
  target.linear().col(0) *= -1;  // a mirror
  assert_int_equal(inverse_kinematics(six_axis, target, home).outcome, InverseOutcome::invalid);
  target = at_home(0.1, 0, 0);
  JointVector bad = home;
  bad[1] = not_a_number;
  const InverseResult result = inverse_kinematics(six_axis, target, bad);
  assert_int_equal(result.outcome, InverseOutcome::invalid);
  assert_true(sane(result));
}

// Anything at all, for never NaN and never outside the limits.
bool random_targets_stay_sane() {
  std::mt19937_64 random(5);
  std::uniform_real_distribution coordinate(-2.5, 2.5);
  int counts[5] = {};
  for (int n = 0; n < random_cases; ++n) {
    Isometry3d target = Isometry3d::Identity();
    target.translation() = Eigen::Vector3d(coordinate(random), coordinate(random), coordinate(random));
    const Eigen::Vector4d quaternion(coordinate(random), coordinate(random), coordinate(random),
                                     coordinate(random));
    target.linear() = Eigen::Quaterniond(quaternion.normalized()).toRotationMatrix();
    const JointVector seed = n % 5 == 0 ? JointVector(JointVector::Zero()) : random_posture(random);
    const InverseResult result = inverse_kinematics(six_axis, target, seed);
    if (!sane(result) || result.iterations > InverseOptions{}.iterations) return false;
    ++counts[static_cast<int>(result.outcome)];
  }
  print_message("converged %d, unreachable %d, singular %d, at limit %d, invalid %d\n", counts[0], counts[1],
                counts[2], counts[3], counts[4]);
  return counts[0] > 0 && counts[1] > 0 && counts[3] > 0 && counts[4] == 0;
}

void test_jacobian(void**) {
  assert_true(jacobian_is_the_derivative());
}
void test_inverse_of_the_arms_poses(void**) {
#ifndef FLEXRF_SANITIZER
  assert_true(has_allocation_guard());
#endif
  assert_true(inverse_finds_poses_of_the_arm());
}
void test_small_motions(void**) {
  assert_true(small_motions_stay_small());
}
void test_random_targets(void**) {
  assert_true(random_targets_stay_sane());
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_forward_at_zero_and_home),  cmocka_unit_test(test_jacobian),
      cmocka_unit_test(test_inverse_of_the_arms_poses), cmocka_unit_test(test_small_motions),
      cmocka_unit_test(test_inverse_from_home),         cmocka_unit_test(test_out_of_reach),
      cmocka_unit_test(test_out_of_the_singular_wrist), cmocka_unit_test(test_a_limit_is_named),
      cmocka_unit_test(test_nonsense_is_refused),       cmocka_unit_test(test_random_targets),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
