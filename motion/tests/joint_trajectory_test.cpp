// Properties of trajectories over random motions: limits hold at every sample, the end is exact, the
// acceleration has no step.
#include "motion/joint_trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "six_axis.hpp"
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;

#ifdef FLEXRF_SANITIZER
constexpr int random_cases = 500;  // a sanitizer makes them thirty times slower
#else
constexpr int random_cases = 10000;
#endif
constexpr int samples = 300;

JointVector random_posture(std::mt19937_64& random) {
  JointVector joints = JointVector::Zero();
  for (std::size_t i = 0; i < six_axis.joint_count; ++i) {
    joints[static_cast<Eigen::Index>(i)] =
        std::uniform_real_distribution(six_axis.joints[i].lower, six_axis.joints[i].upper)(random);
  }
  return joints;
}

void worst(double& so_far, double value) {
  so_far = std::isnan(value) ? std::numeric_limits<double>::infinity() : std::max(so_far, value);
}

// The largest use of a limit over all joints and samples; above 1 is a violation.
struct Use {
  double velocity = 0;
  double acceleration = 0;
  double jerk = 0;
  double range = 0;     // rad outside the joints' ranges
  double mismatch = 0;  // rad between the positions and the integrated velocities
};

Use use_of(const JointTrajectory& trajectory, double from, double until, double speed) {
  Use use;
  const double step = (until - from) / samples;
  JointSample last = trajectory.at(from);
  for (int k = 1; k <= samples; ++k) {
    const double time = k == samples ? until : from + k * step;
    const JointSample now = trajectory.at(time);
    for (std::size_t i = 0; i < six_axis.joint_count; ++i) {
      const auto index = static_cast<Eigen::Index>(i);
      const ChainJoint& joint = six_axis.joints[i];
      worst(use.velocity, std::abs(now.velocity[index]) / (speed * joint.velocity));
      worst(use.acceleration, std::abs(now.acceleration[index]) / (speed * joint.acceleration));
      worst(use.jerk,
            std::abs(now.acceleration[index] - last.acceleration[index]) / (step * speed * joint.jerk));
      worst(use.range, now.position[index] - joint.upper);
      worst(use.range, joint.lower - now.position[index]);
      const double expected = last.position[index] + step * (last.velocity[index] + now.velocity[index]) / 2;
      // The trapezoid's error is at most jerk * step^3 / 12.
      worst(use.mismatch, std::abs(now.position[index] - expected) - joint.jerk * step * step * step / 12);
    }
    last = now;
  }
  return use;
}

bool within(const Use& use) {
  const bool good = use.velocity <= 1 + 1e-9 && use.acceleration <= 1 + 1e-9 && use.jerk <= 1 + 1e-6 &&
                    use.range <= 1e-12 && use.mismatch <= 1e-9;
  if (!good) {
    print_message("velocity %.12f acceleration %.12f jerk %.12f range %g mismatch %g\n", use.velocity,
                  use.acceleration, use.jerk, use.range, use.mismatch);
  }
  return good;
}

bool random_motions_hold() {
  std::mt19937_64 random(1);
  for (int n = 0; n < random_cases; ++n) {
    const JointVector start = random_posture(random);
    JointVector target = random_posture(random);
    // Long, medium, short and tiny motions, some of a single joint.
    if (n % 4 == 1) target = start + 1e-2 * (target - start);
    if (n % 4 == 2) target = start + 1e-6 * (target - start);
    if (n % 4 == 3) {
      const JointVector all = target;
      target = start;
      target[n % 6] = all[n % 6];
    }
    const double speed = n % 3 == 0 ? std::uniform_real_distribution(0.01, 1.0)(random) : 1.0;
    JointTrajectory trajectory;
    if (!trajectory.plan(six_axis, start, target, speed)) return false;
    if (!(trajectory.end_time() > 0) || !(trajectory.end_time() < 1000)) return false;
    if (trajectory.at(0).position != start || trajectory.at(-1).position != start) return false;
    const JointSample end = trajectory.at(trajectory.end_time());
    if (end.position != target || !end.velocity.isZero(0) || !end.acceleration.isZero(0)) return false;
    if (!within(use_of(trajectory, 0, trajectory.end_time(), speed))) return false;
  }
  return true;
}

bool motions_use_a_limit() {
  // The profile is the shortest of its kind: some limit is reached.
  std::mt19937_64 random(2);
  for (int n = 0; n < 1000; ++n) {
    JointTrajectory trajectory;
    if (!trajectory.plan(six_axis, random_posture(random), random_posture(random))) return false;
    const Use use = use_of(trajectory, 0, trajectory.end_time(), 1);
    if (std::max({use.velocity, use.acceleration, use.jerk}) < 0.98) return false;
  }
  return true;
}

bool random_stops_hold() {
  std::mt19937_64 random(3);
  for (int n = 0; n < random_cases; ++n) {
    const JointVector start = random_posture(random);
    const JointVector target = random_posture(random);
    JointTrajectory trajectory;
    if (!trajectory.plan(six_axis, start, target)) return false;
    const double planned_end = trajectory.end_time();
    const double time = std::uniform_real_distribution(0.0, planned_end)(random);
    const JointSample before = trajectory.at(time);
    trajectory.stop(time);
    trajectory.stop(time + 0.01);  // a second one changes nothing
    const JointSample after = trajectory.at(time);
    if (!after.position.isApprox(before.position, 1e-12) || !after.velocity.isApprox(before.velocity, 1e-9) ||
        (after.acceleration - before.acceleration).cwiseAbs().maxCoeff() > 1e-6) {
      return false;
    }
    if (trajectory.end_time() > planned_end + 1e-6) return false;  // stopping takes no longer than going on
    const JointSample end = trajectory.at(trajectory.end_time());
    if (!end.velocity.isZero(0) || !end.acceleration.isZero(0)) return false;
    if (!within(use_of(trajectory, time, trajectory.end_time(), 1))) return false;
  }
  return true;
}

bool stops_from_any_state_hold() {
  std::mt19937_64 random(4);
  std::uniform_real_distribution velocity(-5.0, 5.0);
  std::uniform_real_distribution acceleration(-10.0, 10.0);
  for (int n = 0; n < random_cases; ++n) {
    const MotionLimits limits{1.0, std::exp(std::uniform_real_distribution(-2.0, 3.0)(random)),
                              std::exp(std::uniform_real_distribution(-1.0, 6.0)(random))};
    const MotionState from{0.3, velocity(random), acceleration(random)};
    const JerkProfile profile = JerkProfile::stop(from, limits);
    const double most = std::max(limits.acceleration, std::abs(from.acceleration));
    const double step = profile.duration() / samples;
    if (!std::isfinite(step)) return false;
    MotionState last = profile.at(0);
    if (last.position != from.position || last.velocity != from.velocity) return false;
    for (int k = 1; k <= samples; ++k) {
      const MotionState now = profile.at(k * step);
      if (std::abs(now.acceleration) > most * (1 + 1e-9)) return false;
      if (std::abs(now.acceleration - last.acceleration) > limits.jerk * step * (1 + 1e-6) + 1e-9)
        return false;
      if (std::abs(now.velocity - last.velocity) > most * step * (1 + 1e-6) + 1e-9) return false;
      last = now;
    }
    if (profile.end().velocity != 0 || profile.end().acceleration != 0) return false;
  }
  return true;
}

void test_random_motions_keep_their_limits(void**) {
  assert_true(random_motions_hold());
}
void test_motions_use_a_limit(void**) {
  assert_true(motions_use_a_limit());
}
void test_stops_on_the_way_keep_their_limits(void**) {
  assert_true(random_stops_hold());
}
void test_stops_from_any_state(void**) {
  assert_true(stops_from_any_state_hold());
}

void test_no_motion(void**) {
  JointTrajectory trajectory;
  const JointVector home = home_position(six_axis);
  assert_true(trajectory.plan(six_axis, home, home));
  assert_true(trajectory.end_time() == 0);
  assert_true(trajectory.at(0).position == home);
  trajectory.stop(0);
  assert_true(trajectory.at(1).position == home);
}

void test_bad_numbers_are_refused(void**) {
  JointTrajectory trajectory;
  const JointVector home = home_position(six_axis);
  JointVector bad = home;
  bad[2] = std::numeric_limits<double>::quiet_NaN();
  assert_false(trajectory.plan(six_axis, home, bad));
  assert_true(trajectory.at(1).position == home);
  assert_false(trajectory.plan(six_axis, home, home, 0.0));
  assert_false(trajectory.plan(six_axis, home, home, 1.5));
  KinematicChain chain = six_axis;
  chain.joints[3].jerk = 0;
  JointVector target = home;
  target[0] = 1;
  assert_false(trajectory.plan(chain, home, target));
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_random_motions_keep_their_limits),
      cmocka_unit_test(test_motions_use_a_limit),
      cmocka_unit_test(test_stops_on_the_way_keep_their_limits),
      cmocka_unit_test(test_stops_from_any_state),
      cmocka_unit_test(test_no_motion),
      cmocka_unit_test(test_bad_numbers_are_refused),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
