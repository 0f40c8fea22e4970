#include "units/vision/foot_filter.hpp"

#include <cmath>

#include "tests/cmocka.hpp"

namespace flexrf::foot_filter_test {
namespace {

using namespace flexrf::user;

const Eigen::Vector2d place(0.45, 0.05);
constexpr double radius = 0.02;
constexpr double assumed = 0.09;

/// An obstacle of this height as seen from `aside` of it: its far side is farther away by what it is higher.
SeenFoot seen_from(const Eigen::Vector2d& aside, double height) {
  SeenFoot foot;
  foot.height = assumed;
  foot.lean.head<2>() = aside;
  foot.lean[2] = -0.5 * aside.norm();
  foot.middle = place - foot.lean.head<2>() * (height - assumed);
  foot.radius = radius - foot.lean[2] * (height - assumed);
  return foot;
}

void one_view_is_taken_as_it_is(void**) {
  FootFilter filter;
  const SeenFoot foot = seen_from({0.3, 0}, 0.12);
  filter.begin(foot, 0.001);
  assert_true((filter.middle() - foot.middle).norm() < 1e-4);
  assert_true(std::abs(filter.height() - assumed) < 1e-4);
  assert_true(std::abs(filter.radius() - foot.radius) < 1e-6);
  // Along the line of sight it is as uncertain as the height makes it.
  assert_true(filter.deviation() > 0.008);
}

void two_sides_tell_height_and_place(void**) {
  for (const double height : {0.06, 0.12}) {
    FootFilter filter;
    filter.begin(seen_from({0.3, 0}, height), 0.001);
    filter.correct(seen_from({-0.25, 0.1}, height), 0.001);
    assert_true((filter.middle() - place).norm() < 0.001);
    assert_true(std::abs(filter.height() - height) < 0.002);
    assert_true(filter.deviation() < 0.002);
    assert_true(std::abs(filter.radius() - radius) < 0.001);
  }
}

/// However often it is seen from one side.
void one_side_tells_no_height(void**) {
  FootFilter filter;
  filter.begin(seen_from({0.3, 0}, 0.12), 0.001);
  for (int i = 0; i < 100; ++i) filter.correct(seen_from({0.3, 0}, 0.12), 0.001);
  assert_true(std::abs(filter.height() - assumed) < 1e-3);
  assert_true(filter.deviation() > 0.008);
}

void no_height_is_below_the_table(void**) {
  FootFilter filter;
  filter.begin(seen_from({0.3, 0}, -0.2), 0.001);
  filter.correct(seen_from({-0.3, 0}, -0.2), 0.001);
  assert_true(filter.height() >= 0);
}

void what_drifts_is_followed(void**) {
  FootFilter filter;
  filter.begin(seen_from({0, 0}, assumed), 0.001);
  for (int i = 0; i < 50; ++i) filter.correct(seen_from({0, 0}, assumed), 0.001);
  SeenFoot moved = seen_from({0, 0}, assumed);
  moved.middle += Eigen::Vector2d(0.01, 0);
  filter.drift(0.01);
  filter.correct(moved, 0.001);
  assert_true((filter.middle() - moved.middle).norm() < 0.001);
}

}  // namespace
}  // namespace flexrf::foot_filter_test

int main() {
  using namespace flexrf::foot_filter_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(one_view_is_taken_as_it_is), cmocka_unit_test(two_sides_tell_height_and_place),
      cmocka_unit_test(one_side_tells_no_height), cmocka_unit_test(no_height_is_below_the_table),
      cmocka_unit_test(what_drifts_is_followed)};
  return cmocka_run_group_tests_name("foot filter", tests, nullptr, nullptr);
}
