// The pose stream over random targets that come at irregular times: its limits are looked for in the
// differences of what it gives out.
#include "motion/pose_stream.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include "motion/tests/stream_check.hpp"
#include "runtime/realtime/realtime_scope.hpp"
#include "six_axis.hpp"
#include "tests/cmocka.hpp"
#include "tests/distance_to_line.hpp"

namespace {

using namespace flexrf;
using Eigen::Isometry3d;
using Eigen::Vector3d;

#ifdef FLEXRF_SANITIZER
constexpr int random_streams = 2;  // a sanitizer makes them many times slower
#else
constexpr int random_streams = 20;
#endif
constexpr double cycle = 0.007;   // s
constexpr double max_age = 0.15;  // s
constexpr StreamLimits limits{{0.4, 2.0, 20.0}, {1.2, 5.0, 60.0}};
constexpr StreamLimits fast{{2.0, 10.0, 200.0}, {5.0, 40.0, 800.0}};

struct World {
  explicit World(const JointVector& joints = home_position(six_axis), const StreamLimits& kept = limits)
      : own(kept) {
    stream.use(six_axis, own, max_age);
    stream.seed(joints);
    check.emplace(six_axis, stream);
  }
  void run(double duration) {
    for (double time = 0; time < duration; time += cycle) {
      if (target) static_cast<void>(stream.aim(*target));
      stream.advance(cycle);
      check->look(cycle);
      slowed = slowed || stream.restraint().reason != nullptr;
    }
  }
  bool holds() const {
    if (check->holds(own)) return true;
    print_message("linear %g %g %g, angular %g %g %g, joints %g, range %g, off %g, emergencies %llu\n",
                  check->linear.largest.velocity, check->linear.largest.acceleration,
                  check->linear.largest.jerk, check->angular.largest.velocity,
                  check->angular.largest.acceleration, check->angular.largest.jerk, check->joint_use,
                  check->out_of_range, check->off_the_tool,
                  static_cast<unsigned long long>(stream.emergencies()));
    return false;
  }

  StreamLimits own;
  PoseStream stream;
  std::optional<StreamCheck<PoseStream>> check;
  std::optional<Isometry3d> target;  // told in every cycle
  bool slowed = false;
};

Isometry3d home_pose() {
  return forward_kinematics(six_axis, home_position(six_axis));
}

Isometry3d beside_home(const Vector3d& way, const Vector3d& turn) {
  Isometry3d pose = home_pose();
  pose.translation() += way;
  pose.linear() = rotation_about(turn).toRotationMatrix() * pose.linear();
  return pose;
}

Vector3d random_vector(std::mt19937_64& random, double size) {
  std::uniform_real_distribution one(-size, size);
  const double x = one(random);
  const double y = one(random);
  return {x, y, one(random)};
}

bool random_streams_hold(const StreamLimits& kept, double reach, double turn, unsigned seed) {
  std::mt19937_64 random(seed);
  for (int n = 0; n < random_streams; ++n) {
    World world(home_position(six_axis), kept);
    int wait = 0;
    std::uint32_t way = 0;
    for (int k = 0; k < 800; ++k) {
      if (wait-- == 0) {
        if (n % 2 == 1 && random() % 2 == 0) ++way;
        const Isometry3d next = beside_home(random_vector(random, reach), random_vector(random, turn));
        if (!world.stream.aim(next, 0, way)) return false;
        wait = std::uniform_int_distribution(0, k % 3 == 0 ? 60 : 8)(random);
      }
      AllocationCounter allocations{0};
      {
        const RealtimeScope realtime(allocations);
        world.stream.advance(cycle);
      }
      if (allocations != 0) return false;
      world.check->look(cycle);
    }
    if (!world.holds()) return false;
  }
  return true;
}

/// The stream turns off at a random distance before each corner, as a hand passes via points: it leaves the
/// lines between them by no more than that distance.
bool turns_off_within_the_corner(unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution passes_within(0.005, 0.05);
  for (int n = 0; n < random_streams; ++n) {
    World world(home_position(six_axis), n % 2 == 0 ? limits : StreamLimits{{0.9, 4, 40}, {3, 12, 120}});
    const double near = passes_within(random);
    std::vector<Vector3d> corners{world.stream.motion().pose().translation()};
    for (int k = 0; k < 6; ++k) corners.push_back(home_pose().translation() + random_vector(random, 0.12));
    std::size_t next = 1;
    double left = 0;
    double time = 0;
    for (; time < 30 && !world.stream.has_arrived(); time += cycle) {
      Isometry3d target = beside_home(Vector3d::Zero(), {0, 0, next % 2 == 0 ? 0.0 : 0.3});
      target.translation() = corners[next];
      if (!world.stream.aim(target, 0, static_cast<std::uint32_t>(next))) return false;
      world.stream.advance(cycle);
      world.check->look(cycle);
      const Vector3d place = world.stream.motion().pose().translation();
      double off = std::numeric_limits<double>::infinity();
      for (std::size_t i = 1; i <= next; ++i)
        off = std::min(off, distance_to_line(place, corners[i - 1], corners[i]));
      left = std::max(left, off);
      if (next + 1 < corners.size() && (place - corners[next]).norm() < near) ++next;
    }
    if (left > near || next + 1 != corners.size() || time >= 30 || !world.holds()) {
      print_message("left its ways by %.2f mm, passes within %.2f mm\n", 1000 * left, 1000 * near);
      return false;
    }
  }
  return true;
}

/// In the triangle of the three, to within a hair.
bool is_between(const Vector3d& place, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  Eigen::Matrix<double, 3, 2> sides;
  sides << b - a, c - a;
  const Eigen::Vector2d parts = (sides.transpose() * sides).ldlt().solve(sides.transpose() * (place - a));
  return (sides * parts - (place - a)).norm() < 1e-8 && parts.minCoeff() > -1e-6 && parts.sum() < 1 + 1e-6;
}

/// Called off anywhere, at any speed: between where it was, where it would have come to rest, and the goal.
bool turns_off_anywhere(unsigned seed) {
  std::mt19937_64 random(seed);
  for (int n = 0; n < 10 * random_streams; ++n) {
    World world;
    const Isometry3d first = beside_home(random_vector(random, 0.2), Vector3d::Zero());
    const int cycles = std::uniform_int_distribution(5, 100)(random);
    for (int k = 0; k < cycles; ++k) {
      if (!world.stream.aim(first, 0, 1)) return false;
      world.stream.advance(cycle);
      world.check->look(cycle);
    }
    const Vector3d here = world.stream.motion().pose().translation();
    PoseStream stops = world.stream;
    stops.let_go();
    while (!stops.is_at_rest()) stops.advance(cycle);
    const Vector3d rest = stops.motion().pose().translation();
    const Isometry3d goal = beside_home(random_vector(random, 0.2), Vector3d::Zero());
    for (int k = 0; k < 1000 && !world.stream.has_arrived(); ++k) {
      if (!world.stream.aim(goal, 0, 2)) return false;
      world.stream.advance(cycle);
      world.check->look(cycle);
      if (!is_between(world.stream.motion().pose().translation(), here, rest, goal.translation()))
        return false;
    }
    if (!world.stream.has_arrived() || !world.holds()) return false;
  }
  return true;
}

/// Stopped from outside while it turns off: nothing of that is left in what begins there.
bool is_seeded_while_it_turns_off() {
  World world;
  world.target = beside_home({0.2, 0, 0}, Vector3d::Zero());
  world.run(0.5);
  if (!world.stream.aim(beside_home({0, 0.2, 0}, Vector3d::Zero()), 0, 1)) return false;
  for (int k = 0; k < 5; ++k) world.stream.advance(cycle);
  if (world.stream.is_at_rest()) return false;
  world.stream.seed(world.stream.set_point());
  const Isometry3d goal = beside_home({0, -0.1, 0}, Vector3d::Zero());
  for (int k = 0; k < 600 && !world.stream.has_arrived(); ++k) {
    if (!world.stream.aim(goal, 0, 1)) return false;
    world.stream.advance(cycle);
  }
  return world.stream.has_arrived();
}

void test_turns_off_within_the_corner(void**) {
  assert_true(turns_off_within_the_corner(3));
}
void test_turns_off_anywhere(void**) {
  assert_true(turns_off_anywhere(4));
}

// Near home nothing is in the way.
bool arrives_on_a_straight_line() {
  World world;
  const Isometry3d begin = world.stream.motion().pose();
  const Vector3d way(0.1, -0.15, -0.08);
  world.target = beside_home(way, {0, 0, 0.3});
  double off = 0;
  for (int k = 0; k < 600 && !world.stream.has_arrived(); ++k) {
    world.run(cycle / 2);
    const Vector3d moved = world.stream.motion().pose().translation() - begin.translation();
    off = std::max(off, (moved - moved.dot(way.normalized()) * way.normalized()).norm());
  }
  // 4/5 of the limits are the way's own.
  return world.stream.has_arrived() && off < 1e-9 && !world.slowed && world.holds() &&
         world.check->linear.largest.velocity > 0.75 * limits.linear.velocity;
}

bool stays_where_it_arrived() {
  World world;
  world.target = beside_home({0, 0.05, 0}, {0.1, 0, 0});
  world.run(3);
  if (!world.stream.has_arrived()) return false;
  const JointVector rest = world.stream.set_point();
  world.run(1);
  return (world.stream.set_point() - rest).cwiseAbs().maxCoeff() < 1e-9 && world.stream.is_at_rest();
}

// By itself, within its limits, and in the time that those need.
bool brakes_when_no_more_comes() {
  World world;
  world.target = beside_home({0, 0.4, 0}, {0, 0, 0.5});
  world.run(0.8);
  const Vector3d last = world.stream.motion().pose().translation();
  world.target.reset();
  world.run(max_age - 2 * cycle);
  if (world.stream.is_stale() || world.stream.is_at_rest()) return false;
  world.run(3 * cycle + 0.5);  // 0.32 m/s with 1.6 m/s^2 and 16 m/s^3
  if (!world.stream.is_stale() || !world.stream.is_at_rest() || world.stream.has_arrived()) return false;
  const Vector3d rest = world.stream.motion().pose().translation();
  world.run(1);
  if ((world.stream.motion().pose().translation() - rest).norm() > 0 || (rest - last).norm() > 0.15)
    return false;
  // And goes on when there is one again.
  world.target = beside_home({0, 0.4, 0}, {0, 0, 0.5});
  world.run(4);
  return world.stream.has_arrived() && world.holds();
}

bool let_go_is_no_jump() {
  World world;
  world.target = beside_home({0, 0.3, 0}, {0, 0, 0});
  world.run(0.5);
  world.target.reset();
  world.stream.let_go();
  world.run(1);
  return world.stream.is_at_rest() && !world.stream.has_arrived() && world.holds();
}

// Out of reach: as far as it gets, and told.
bool stops_before_what_it_cannot_reach() {
  for (const Vector3d& way : {Vector3d(2, 0, 0), Vector3d(0, 0, 1), Vector3d(-0.7, 0, -0.9)}) {
    World world;
    world.target = beside_home(way, {0, 0, 0});
    world.run(8);
    if (!world.stream.is_at_rest() || world.stream.has_arrived()) return false;
    if (world.stream.restraint().reason == nullptr || !world.holds()) return false;
    const JointVector rest = world.stream.set_point();
    world.run(1);
    if (world.stream.set_point() != rest) return false;
    // Back it may.
    world.target = home_pose();
    world.run(10);
    if (!world.stream.has_arrived() || !world.holds()) return false;
  }
  return true;
}

// A joint's range ends on the way: the tool turns about itself, which only the last joint does.
bool stops_before_the_end_of_a_joint() {
  World world;
  for (int k = 0; k < 12 && world.stream.restraint().reason == nullptr; ++k) {
    Isometry3d next = world.stream.motion().pose();
    next.linear() = next.linear() * Eigen::AngleAxisd(1.0, Vector3d::UnitZ()).toRotationMatrix();
    world.target = next;
    world.run(2);
  }
  const double range = six_axis.joints[5].upper;
  return world.stream.restraint().reason != nullptr && world.stream.is_at_rest() &&
         std::abs(world.stream.set_point()[5]) > 0.95 * range && world.holds();
}

// Past a straight wrist, sideways, with limits of the tool that no joint could keep up with: slower, and
// told.
bool is_slow_where_the_arm_is_singular() {
  JointVector joints = home_position(six_axis);
  joints[4] = 0.08;  // 0 is the singular posture
  World world(joints, fast);
  Isometry3d beside = forward_kinematics(six_axis, joints);
  beside.translation().y() += 0.35;
  beside.translation().z() += 0.05;
  world.target = beside;
  world.run(6);
  return world.slowed && world.holds() && world.check->joint_use > 0.5;
}

bool what_is_no_pose_is_refused() {
  World world;
  world.target = beside_home({0, 0.1, 0}, {0, 0, 0});
  world.run(0.3);
  Isometry3d bad = *world.target;
  bad.translation().x() = std::numeric_limits<double>::quiet_NaN();
  if (world.stream.aim(bad)) return false;
  bad = *world.target;
  bad.linear() *= 2;
  if (world.stream.aim(bad)) return false;
  bad = *world.target;
  bad.translation().z() = 1e9;
  if (world.stream.aim(bad)) return false;
  if (world.stream.aim(*world.target, std::numeric_limits<double>::quiet_NaN())) return false;
  if (world.stream.aim(*world.target, 0, 0, std::numeric_limits<double>::quiet_NaN())) return false;
  world.run(3);
  return world.stream.has_arrived() && world.holds();
}

void test_random_streams_keep_their_limits(void**) {
#ifndef FLEXRF_SANITIZER
  assert_true(has_allocation_guard());
#endif
  assert_true(random_streams_hold(limits, 0.15, 0.4, 1));
}
void test_random_streams_beyond_the_arms_limits(void**) {
  assert_true(random_streams_hold(fast, 0.6, 1.5, 2));
}

template <bool (*Run)()>
void passes(void**) {
  assert_true(Run());
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_random_streams_keep_their_limits),
      cmocka_unit_test(test_random_streams_beyond_the_arms_limits),
      cmocka_unit_test(test_turns_off_within_the_corner),
      cmocka_unit_test(test_turns_off_anywhere),
      {"seeded while it turns off", passes<is_seeded_while_it_turns_off>, nullptr, nullptr, nullptr},
      {"arrives on a straight line", passes<arrives_on_a_straight_line>, nullptr, nullptr, nullptr},
      {"stays where it arrived", passes<stays_where_it_arrived>, nullptr, nullptr, nullptr},
      {"brakes when no more comes", passes<brakes_when_no_more_comes>, nullptr, nullptr, nullptr},
      {"let go is no jump", passes<let_go_is_no_jump>, nullptr, nullptr, nullptr},
      {"stops before what it cannot reach", passes<stops_before_what_it_cannot_reach>, nullptr, nullptr,
       nullptr},
      {"stops before the end of a joint", passes<stops_before_the_end_of_a_joint>, nullptr, nullptr, nullptr},
      {"is slow where the arm is singular", passes<is_slow_where_the_arm_is_singular>, nullptr, nullptr,
       nullptr},
      {"what is no pose is refused", passes<what_is_no_pose_is_refused>, nullptr, nullptr, nullptr},
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
