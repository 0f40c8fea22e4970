#include "units/vision/object_filter.hpp"

#include <cmath>
#include <numbers>

#include "tests/cmocka.hpp"

namespace flexrf::object_filter_test {
namespace {

using namespace flexrf::user;

constexpr double frame = 1.0 / 30;

/// In turn to either side, so that the mean is right.
double wobble(int i) {
  return i % 2 == 0 ? 0.001 : -0.001;
}

void what_lies_is_known_better_and_better(void**) {
  FilterNoise noise;
  noise.drift = 0;
  ObjectFilter filter;
  filter.begin({0.401, 0.099}, 0.3, false, noise);
  const double first = filter.deviation();
  for (int i = 1; i < 100; ++i) {
    filter.predict(frame, false, noise);
    filter.correct({0.4 + wobble(i), 0.1 - wobble(i)}, 0.3, 1, noise);
  }
  assert_true((filter.position() - Eigen::Vector2d(0.4, 0.1)).norm() < 1e-4);
  assert_true(std::abs(filter.deviation() - first / 10) < 1e-6);  // of the mean of 100
  assert_true(filter.velocity().isZero(0));
}

void what_is_not_seen_is_known_less(void**) {
  const FilterNoise noise;
  ObjectFilter filter;
  filter.begin({0.4, 0.1}, 0.3, false, noise);
  const double before = filter.deviation();
  filter.predict(9, false, noise);
  assert_true(std::abs(filter.deviation() - std::hypot(before, 3 * noise.drift)) < 1e-9);
}

void on_a_belt_its_velocity_is_found(void**) {
  const FilterNoise noise;
  ObjectFilter filter;
  filter.begin({0.3, 0.1}, 0, true, noise);
  const Eigen::Vector2d velocity(0.15, -0.02);
  for (int i = 1; i <= 60; ++i) {
    filter.predict(frame, true, noise);
    const Eigen::Vector2d there = Eigen::Vector2d(0.3, 0.1) + velocity * (i * frame);
    filter.correct(there, 0, 1, noise);
  }
  assert_true((filter.velocity() - velocity).norm() < 0.01);
  filter.predict(0.1, true, noise);
  assert_true((filter.position() - (Eigen::Vector2d(0.3, 0.1) + velocity * 2.1)).norm() < 0.002);
}

void angles_that_look_the_same_are_the_same(void**) {
  const FilterNoise noise;
  constexpr double pi = std::numbers::pi;
  ObjectFilter filter;
  filter.begin({0, 0}, pi / 2 - 0.01, false, noise);
  // A block half a turn on, seen from the other side of the seam.
  for (int i = 0; i < 30; ++i) {
    filter.predict(frame, false, noise);
    filter.correct({0, 0}, -pi / 2 + 0.01, 2, noise);
  }
  assert_true(std::abs(filter.angle()) > pi / 2 - 0.02);
}

}  // namespace
}  // namespace flexrf::object_filter_test

int main() {
  using namespace flexrf::object_filter_test;
  const CMUnitTest tests[] = {cmocka_unit_test(what_lies_is_known_better_and_better),
                              cmocka_unit_test(what_is_not_seen_is_known_less),
                              cmocka_unit_test(on_a_belt_its_velocity_is_found),
                              cmocka_unit_test(angles_that_look_the_same_are_the_same)};
  return cmocka_run_group_tests_name("object filter", tests, nullptr, nullptr);
}
