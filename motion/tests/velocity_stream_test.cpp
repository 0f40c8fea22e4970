// The velocity stream over what random hands want: its limits are looked for in the differences of what it
// gives out.
#include "motion/velocity_stream.hpp"

#include <limits>
#include <optional>
#include <random>

#include "motion/tests/stream_check.hpp"
#include "runtime/realtime/realtime_scope.hpp"
#include "six_axis.hpp"
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;
using Eigen::Vector3d;

#ifdef FLEXRF_SANITIZER
constexpr int random_streams = 2;  // a sanitizer makes them many times slower
#else
constexpr int random_streams = 20;
#endif
constexpr double cycle = 0.007;  // s
constexpr double max_age = 0.1;  // s
constexpr StreamLimits limits{{0.25, 0.5, 25.0}, {1.0, 2.0, 100.0}};

struct World {
  World() {
    stream.use(six_axis, limits, max_age);
    stream.seed(home_position(six_axis));
    check.emplace(six_axis, stream);
  }
  void run(double duration) {
    for (double time = 0; time < duration; time += cycle) {
      if (hand_lives) static_cast<void>(stream.want(wanted));
      stream.advance(cycle);
      check->look(cycle);
    }
  }
  bool holds() const {
    if (check->holds(limits)) return true;
    print_message("linear %g %g %g, angular %g %g %g, joints %g, range %g, off %g, emergencies %llu\n",
                  check->linear.largest.velocity, check->linear.largest.acceleration,
                  check->linear.largest.jerk, check->angular.largest.velocity,
                  check->angular.largest.acceleration, check->angular.largest.jerk, check->joint_use,
                  check->out_of_range, check->off_the_tool,
                  static_cast<unsigned long long>(stream.emergencies()));
    return false;
  }
  Vector3d position() const { return stream.motion().pose().translation(); }

  VelocityStream stream;
  std::optional<StreamCheck<VelocityStream>> check;
  ToolVelocity wanted;
  bool hand_lives = true;
};

Vector3d random_vector(std::mt19937_64& random, double size) {
  std::uniform_real_distribution one(-size, size);
  const double x = one(random);
  const double y = one(random);
  return {x, y, one(random)};
}

// Hands that jump, hands that turn slowly as a joystick does, hands that let go; more than is allowed among
// them. The arm runs into all its ends.
bool random_hands_hold() {
  std::mt19937_64 random(1);
  for (int n = 0; n < random_streams; ++n) {
    World world;
    int wait = 0;
    for (int k = 0; k < 1000; ++k) {
      if (n % 2 == 1) {
        const double angle = 0.01 * k;
        world.wanted.linear = 0.2 * Vector3d(std::cos(angle), std::sin(angle), std::sin(0.3 * angle));
        world.wanted.angular = 0.5 * Vector3d(0, std::sin(0.5 * angle), std::cos(angle));
      } else if (wait-- == 0) {
        world.wanted = {};
        if (k % 5 != 0) world.wanted.linear = random_vector(random, 0.3);
        if (k % 7 != 0) world.wanted.angular = random_vector(random, 0.8);
        wait = std::uniform_int_distribution(0, k % 3 == 0 ? 150 : 10)(random);
      }
      if (!world.stream.want(world.wanted)) return false;
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

bool a_velocity_is_taken_up_on_a_straight_line() {
  World world;
  const Vector3d begin = world.position();
  const Vector3d direction = Vector3d(-0.3, 0.8, -0.2).normalized();
  world.wanted.linear = 0.1 * direction;
  double off = 0;
  for (int k = 0; k < 200; ++k) {
    world.run(cycle / 2);
    const Vector3d way = world.position() - begin;
    off = std::max(off, (way - way.dot(direction) * direction).norm());
  }
  const Vector3d middle = world.position();
  world.run(1.0 - cycle / 2);
  const double speed = (world.position() - middle).norm() / (cycle * 143);
  return off < 1e-9 && std::abs(speed - 0.1) < 1e-6 && world.holds() &&
         world.stream.restraint().reason == nullptr;
}

// 0.1 m/s at 0.5 m/s^2 and 25 m/s^3: 0.22 s, and 11 mm. Each cycle is slower than the one before.
bool brakes_at_once_when_let_go() {
  World world;
  world.wanted.linear = {0, 0, -0.1};
  world.run(1);
  world.wanted = {};
  const Vector3d begin = world.position();
  double last = 0.1;
  int cycles = 0;
  while (!world.stream.is_at_rest() && cycles < 40) {
    const Vector3d before = world.position();
    world.run(cycle / 2);
    const double speed = (world.position() - before).norm() / cycle;
    if (!(speed < last)) return false;
    last = speed;
    ++cycles;
  }
  return cycles < 34 && (world.position() - begin).norm() < 0.0115 && world.holds();
}

bool rests_when_nobody_tells() {
  World world;
  world.wanted.linear = {0, 0.1, 0};
  world.wanted.angular = {0, 0, 0.3};
  world.run(1);
  world.hand_lives = false;
  world.run(max_age - 2 * cycle);
  if (world.stream.is_stale() || world.stream.motion().velocity().norm() < 0.0999) return false;
  world.run(3 * cycle + 0.25);
  return world.stream.is_stale() && world.stream.is_at_rest() && world.holds();
}

bool too_much_is_shortened_and_told() {
  World world;
  world.wanted.linear = {0, -3, 0};
  world.wanted.angular = {0, 0, 0.1};
  world.run(1.5);
  const Restraint told = world.stream.restraint();
  return told.reason != nullptr && told.asked == 3 && told.given == limits.linear.velocity &&
         std::abs(world.stream.motion().velocity().norm() - limits.linear.velocity) < 1e-9 && world.holds();
}

// Forwards until the elbow is stretched, and back.
bool rests_where_the_arm_ends_and_comes_back() {
  World world;
  world.wanted.linear = {0.25, 0, 0};
  world.run(8);
  if (!world.stream.is_at_rest() || world.stream.restraint().reason == nullptr) return false;
  const JointVector rest = world.stream.set_point();
  world.run(1);
  if (world.stream.set_point() != rest || world.position().x() < 1.15) return false;
  world.wanted.linear = {-0.25, 0, 0};
  world.run(2);
  return world.stream.motion().velocity().x() < -0.2 && world.holds();
}

bool what_is_not_a_number_is_refused() {
  World world;
  world.wanted.linear = {0, 0.1, 0};
  world.run(0.5);
  ToolVelocity bad = world.wanted;
  bad.angular.x() = std::numeric_limits<double>::quiet_NaN();
  if (world.stream.want(bad)) return false;
  if (world.stream.want(world.wanted, std::numeric_limits<double>::infinity())) return false;
  world.hand_lives = false;
  world.run(0.5);
  return world.stream.is_at_rest() && world.holds();
}

void test_random_hands_keep_their_limits(void**) {
#ifndef FLEXRF_SANITIZER
  assert_true(has_allocation_guard());
#endif
  assert_true(random_hands_hold());
}

template <bool (*Run)()>
void passes(void**) {
  assert_true(Run());
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_random_hands_keep_their_limits),
      {"a velocity is taken up on a straight line", passes<a_velocity_is_taken_up_on_a_straight_line>,
       nullptr, nullptr, nullptr},
      {"brakes at once when let go", passes<brakes_at_once_when_let_go>, nullptr, nullptr, nullptr},
      {"rests when nobody tells", passes<rests_when_nobody_tells>, nullptr, nullptr, nullptr},
      {"too much is shortened and told", passes<too_much_is_shortened_and_told>, nullptr, nullptr, nullptr},
      {"rests where the arm ends and comes back", passes<rests_where_the_arm_ends_and_comes_back>, nullptr,
       nullptr, nullptr},
      {"what is not a number is refused", passes<what_is_not_a_number_is_refused>, nullptr, nullptr, nullptr},
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
