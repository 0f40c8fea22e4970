// Set-points of one axis whose cycles are not all as long as each other. With a constant cycle, and with a
// chain's limits: paced_arm_test.
#include "motion/set_point_follower.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;

constexpr SetPointFollower::Limits limits{.lowest = -2, .highest = 2, .velocity = 3, .acceleration = 9};
constexpr double cycle = 0.007;  // s

void a_cycle_without_time_changes_nothing(void**) {
  SetPointFollower follower(limits);
  follower.seed(1);
  follower.command(2);
  assert_true(follower.next(0) == 1 && follower.next(-1) == 1);
  assert_true(follower.next(cycle) > 1);
}

// An axis without ends, far from zero, where a double is coarse.
void an_axis_without_ends_arrives_exactly(void**) {
  SetPointFollower follower({.velocity = 3, .acceleration = 9});
  follower.seed(1e6);
  follower.command(1e6 + 2.5);
  for (int i = 0; i < 400; ++i) follower.next(cycle);
  assert_true(follower.set_point() == 1e6 + 2.5 && follower.is_at_rest());
}

// Of a motion within the limits, cycles that come early and late are met exactly, too.
void uneven_cycles_do_not_fall_behind(void**) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uneven(0.9 * cycle, 1.1 * cycle);
  SetPointFollower follower(limits);
  double now = 0;
  double worst = 0;
  while (now < 5) {
    const double time = uneven(random);
    now += time;
    const double wanted = 0.5 * (1 - std::cos(3 * now));
    follower.command(wanted);
    worst = std::max(worst, std::abs(follower.next(time) - wanted));
  }
  assert_true(worst < 1e-9);
}

void no_order_of_commands_passes_an_end_or_a_limit(void**) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> anywhere(-5, 5);
  for (int run = 0; run < 200; ++run) {
    SetPointFollower follower(limits);
    double before = 0;
    double velocity = 0;
    for (int i = 0; i < 500; ++i) {
      switch (random() % 40) {
        case 0:
        case 1:
          follower.command(anywhere(random));
          break;
        case 2:
          follower.brake();
          break;
        case 3:
          follower.command(follower.set_point() + 0.01 * anywhere(random));
          break;
        default:
          break;
      }
      const double after = follower.next(cycle);
      const double now = (after - before) / cycle;
      assert_true(after >= limits.lowest - 1e-12 && after <= limits.highest + 1e-12);
      assert_true(std::abs(now) <= limits.velocity + 1e-9);
      assert_true(std::abs(now - velocity) <= limits.acceleration * cycle + 1e-9);
      before = after;
      velocity = now;
    }
  }
}

void a_command_ends_a_braking(void**) {
  SetPointFollower follower(limits);
  follower.command(2);
  for (int i = 0; i < 40; ++i) follower.next(cycle);
  follower.brake();
  for (int i = 0; i < 100; ++i) follower.next(cycle);
  assert_true(follower.is_at_rest() && follower.wanted() == follower.set_point());
  const double rest = follower.set_point();
  assert_true(rest > 0 && rest < 2);
  follower.command(2);
  for (int i = 0; i < 400; ++i) follower.next(cycle);
  assert_true(follower.set_point() == 2);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_cycle_without_time_changes_nothing),
      cmocka_unit_test(an_axis_without_ends_arrives_exactly),
      cmocka_unit_test(uneven_cycles_do_not_fall_behind),
      cmocka_unit_test(no_order_of_commands_passes_an_end_or_a_limit),
      cmocka_unit_test(a_command_ends_a_braking),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
