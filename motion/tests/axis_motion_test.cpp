// Properties of the motion along one coordinate, over random limits, states and goals that change on the way.
#include "motion/axis_motion.hpp"

#include <cmath>
#include <random>

#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;

#ifdef FLEXRF_SANITIZER
constexpr int random_cases = 50;  // a sanitizer makes them many times slower
#else
constexpr int random_cases = 1000;
#endif
constexpr double cycle = 0.007;  // s

double between(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution(low, high)(random);
}

MotionLimits random_limits(std::mt19937_64& random) {
  return {std::exp(between(random, -3, 1)), std::exp(between(random, -1, 2)),
          std::exp(between(random, 1, 5))};
}

/// What two states `time` s apart say of what was between them.
bool keeps(const MotionState& from, const MotionState& to, double time, const MotionLimits& limits) {
  constexpr double hair = 1 + 1e-9;
  const double jerk = std::abs(to.acceleration - from.acceleration) / time;
  const double mean = (to.position - from.position) / time;
  // Between two states whose velocities are within the limit it is so too, but for a peak where the
  // acceleration changes its sign.
  return std::abs(to.velocity) <= limits.velocity * hair && std::abs(mean) <= limits.velocity * hair &&
         std::abs(to.acceleration) <= limits.acceleration * hair && jerk <= limits.jerk * (1 + 1e-6) + 1e-9;
}

// Goals that jump about, and times between cycles that do.
bool random_goals_hold() {
  std::mt19937_64 random(1);
  for (int n = 0; n < random_cases; ++n) {
    const MotionLimits limits = random_limits(random);
    MotionState now{};
    double goal = 0;
    for (int k = 0; k < 400; ++k) {
      if (k % 40 == 0) goal = between(random, -0.5, 0.5);
      if (k % 100 == 99) goal = now.position + between(random, -1e-4, 1e-4);
      const double time = between(random, 0.001, 0.02);
      const MotionState next = towards_position(now, goal, limits, time);
      if (!keeps(now, next, time, limits)) {
        print_message("case %d, cycle %d: %g %g %g -> %g %g %g\n", n, k, now.position, now.velocity,
                      now.acceleration, next.position, next.velocity, next.acceleration);
        return false;
      }
      now = next;
    }
    // It comes to rest exactly, and stays.
    for (int k = 0; k < 20000 && !(now.velocity == 0 && now.acceleration == 0); ++k)
      now = towards_position(now, goal, limits, cycle);
    const MotionState after = towards_position(now, goal, limits, cycle);
    if (std::abs(now.position - goal) > 1e-9 || after.velocity != 0 ||
        std::abs(after.position - now.position) > 1e-11)
      return false;
  }
  return true;
}

// From rest to rest it is the shortest profile of its kind, and never beyond the goal.
bool from_rest_it_is_the_fastest() {
  std::mt19937_64 random(2);
  for (int n = 0; n < random_cases; ++n) {
    const MotionLimits limits = random_limits(random);
    const double goal = between(random, 0.001, 1.0);
    const double shortest = JerkProfile::rest_to_rest(goal, limits).duration();
    MotionState now{};
    double time = 0;
    while (time < 10 * shortest && !(time > 0 && now.velocity == 0 && now.acceleration == 0)) {
      now = towards_position(now, goal, limits, cycle);
      time += cycle;
      if (now.position > goal + 1e-9) return false;
    }
    if (std::abs(now.position - goal) > 1e-9 || time > shortest + 2 * cycle || time < shortest - 1e-9) {
      print_message("case %d: %g s for a way that takes %g s, ends %g off\n", n, time, shortest,
                    now.position - goal);
      return false;
    }
  }
  return true;
}

// The way does not depend on how often one looks.
bool steps_add_up() {
  std::mt19937_64 random(3);
  for (int n = 0; n < random_cases; ++n) {
    const MotionLimits limits = random_limits(random);
    const double goal = between(random, -1.0, 1.0);
    MotionState one{};
    MotionState two{};
    for (int k = 0; k < 100; ++k) {
      one = towards_position(one, goal, limits, 2 * cycle);
      two = towards_position(towards_position(two, goal, limits, cycle), goal, limits, cycle);
      if (std::abs(one.position - two.position) > 1e-8) return false;
    }
  }
  return true;
}

bool velocities_are_taken_up() {
  std::mt19937_64 random(4);
  for (int n = 0; n < random_cases; ++n) {
    const MotionLimits limits = random_limits(random);
    MotionState now{};
    for (int k = 0; k < 10; ++k) {
      const double wanted = between(random, -1, 1) * limits.velocity;
      const int cycles = k == 9 ? 3000 : 20;
      for (int c = 0; c < cycles; ++c) {
        const MotionState next = towards_velocity(now, wanted, limits, cycle);
        if (!keeps(now, next, cycle, limits)) return false;
        now = next;
      }
      if (k == 9 && (std::abs(now.velocity - wanted) > 1e-12 || now.acceleration != 0)) return false;
    }
  }
  return true;
}

// A limit that became lower is come back to, within the other limits.
bool a_lower_velocity_is_come_back_to() {
  const MotionLimits limits{1.0, 2.0, 20.0};
  MotionState now{};
  for (int k = 0; k < 200; ++k) now = towards_position(now, 100, limits, cycle);
  const MotionLimits lower{0.25, 2.0, 20.0};
  for (int k = 0; k < 200; ++k) {
    const MotionState next = towards_position(now, 100, lower, cycle);
    if (next.velocity > now.velocity + 1e-12 || std::abs(next.acceleration) > 2.0 + 1e-9) return false;
    now = next;
  }
  return std::abs(now.velocity - 0.25) < 1e-9;
}

void test_random_goals_keep_their_limits(void**) {
  assert_true(random_goals_hold());
}
void test_from_rest_it_is_the_fastest(void**) {
  assert_true(from_rest_it_is_the_fastest());
}
void test_steps_add_up(void**) {
  assert_true(steps_add_up());
}
void test_velocities_are_taken_up(void**) {
  assert_true(velocities_are_taken_up());
}
void test_a_lower_velocity_is_come_back_to(void**) {
  assert_true(a_lower_velocity_is_come_back_to());
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_random_goals_keep_their_limits),
      cmocka_unit_test(test_from_rest_it_is_the_fastest),
      cmocka_unit_test(test_steps_add_up),
      cmocka_unit_test(test_velocities_are_taken_up),
      cmocka_unit_test(test_a_lower_velocity_is_come_back_to),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
