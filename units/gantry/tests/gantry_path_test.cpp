#include "units/gantry/gantry_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;
using namespace flexrf::user;

constexpr double cycle = 0.01;  // s
constexpr GantryLimits limits{MotionLimits{0.5, 2, 20}, MotionLimits{0.25, 1, 10}};

struct Trace {
  int cycles = 0;
  double fastest[2] = {0, 0};
  double farthest_from_line = 0;  // m
};

/// Until it rests; a stop after so many cycles.
Trace follow(GantryPath& path, const GantryPoint& from, const GantryPoint& to, int stop_after = 1'000'000) {
  Trace trace;
  const double length = std::hypot(to[0] - from[0], to[1] - from[1]);
  while (path.is_moving() && trace.cycles < 10'000) {
    if (trace.cycles == stop_after) path.stop();
    const GantryPoint before = path.point();
    path.advance(cycle);
    for (std::size_t axis = 0; axis < 2; ++axis) {
      trace.fastest[axis] =
          std::max(trace.fastest[axis], std::abs(path.point()[axis] - before[axis]) / cycle);
    }
    const double beside =
        (path.point()[0] - from[0]) * (to[1] - from[1]) - (path.point()[1] - from[1]) * (to[0] - from[0]);
    trace.farthest_from_line = std::max(trace.farthest_from_line, std::abs(beside) / length);
    ++trace.cycles;
  }
  return trace;
}

void both_axes_arrive_together_within_their_limits(void**) {
  GantryPath path;
  path.seed({0.1, 0.2});
  assert_true(path.plan({0.5, 0.05}, limits, 1.0));
  const Trace trace = follow(path, {0.1, 0.2}, {0.5, 0.05});
  assert_true(!path.is_moving());
  assert_true(path.point() == GantryPoint({0.5, 0.05}));
  assert_true(trace.fastest[0] > 0.4 && trace.fastest[0] <= 0.5 + 1e-9);
  assert_true(trace.fastest[1] <= 0.25 + 1e-9);
  assert_true(trace.farthest_from_line < 1e-9);
}

void a_fast_axis_waits_for_a_slow_one(void**) {
  GantryPath path;
  path.seed({0, 0});
  assert_true(path.plan({0.3, 0.3}, limits, 1.0));
  const Trace trace = follow(path, {0, 0}, {0.3, 0.3});
  assert_true(trace.fastest[0] <= 0.25 + 1e-9 && trace.fastest[1] <= 0.25 + 1e-9);
}

void half_the_speed_takes_longer(void**) {
  GantryPath path;
  path.seed({0, 0});
  assert_true(path.plan({0.4, 0}, limits, 1.0));
  const int whole = follow(path, {0, 0}, {0.4, 0}).cycles;
  assert_true(path.plan({0, 0}, limits, 0.5));
  const Trace back = follow(path, {0.4, 0}, {0, 0});
  assert_true(back.cycles > whole && back.fastest[0] <= 0.25 + 1e-9);
}

void stopped_it_rests_on_the_line_before_the_target(void**) {
  GantryPath path;
  path.seed({0, 0});
  assert_true(path.plan({0.4, 0.1}, limits, 1.0));
  const Trace trace = follow(path, {0, 0}, {0.4, 0.1}, 40);
  assert_true(!path.is_moving());
  assert_true(path.point()[0] > 0.05 && path.point()[0] < 0.39);
  assert_true(trace.farthest_from_line < 1e-9);
  // And goes on from there.
  assert_true(path.plan({0.4, 0.1}, limits, 1.0));
  follow(path, {0, 0}, {0.4, 0.1});
  assert_true(path.point() == GantryPoint({0.4, 0.1}));
}

void what_makes_no_sense_is_refused(void**) {
  GantryPath path;
  path.seed({0.1, 0.2});
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  assert_false(path.plan({nothing, 0}, limits, 1.0));
  assert_false(path.plan({0, std::numeric_limits<double>::infinity()}, limits, 1.0));
  assert_false(path.plan({0, 0}, limits, 0));
  assert_false(path.plan({0, 0}, limits, 1.5));
  assert_false(path.plan({0, 0}, limits, nothing));
  assert_true(!path.is_moving() && path.point() == GantryPoint({0.1, 0.2}));
  // Where it is already it need not go.
  assert_true(path.plan({0.1, 0.2}, limits, 1.0));
  assert_true(!path.is_moving());
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(both_axes_arrive_together_within_their_limits),
      cmocka_unit_test(a_fast_axis_waits_for_a_slow_one),
      cmocka_unit_test(half_the_speed_takes_longer),
      cmocka_unit_test(stopped_it_rests_on_the_line_before_the_target),
      cmocka_unit_test(what_makes_no_sense_is_refused),
  };
  return cmocka_run_group_tests_name("gantry path", tests, nullptr, nullptr);
}
