#include "hal/scene/world/plane_geometry.hpp"

#include <cmath>

#include "hal/scene/interface/scene_shapes.hpp"
#include "hal/scene/world/solid.hpp"
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;

// Each case runs in here, so that a failing assertion jumps over no destructor.
template <bool (*Run)()>
void judged(void**) {
  assert_true(Run());
}

bool is_near(double one, double other, double within = 1e-12) {
  return std::abs(one - other) <= within;
}

// Two squares of 2 m, one of them 1.5 m to the right and 0.2 m up.
bool squares_overlap_by_their_least_way_out() {
  const Outline one = rectangle(2, 2);
  const Outline other = placed(rectangle(2, 2), {1.5, 0.2}, 0);
  const Separation found = separation_of(one, other);
  if (!is_near(found.gap, -0.5) || !is_near(found.normal.x, 1) || !is_near(found.normal.y, 0)) return false;
  // Sides lie on each other from -0.8 to 1: they touch in the middle of that.
  if (!is_near(found.point.x, 0.75) || !is_near(found.point.y, 0.1)) return false;
  const Separation back = separation_of(other, one);
  return is_near(back.gap, -0.5) && is_near(back.normal.x, -1);
}

bool what_is_apart_has_a_gap() {
  const Outline one = rectangle(2, 2);
  // Turned by an eighth: a corner is sqrt(2) from its middle.
  const Outline corner = placed(rectangle(2, 2), {3, 0}, std::atan(1.0));
  const Separation found = separation_of(one, corner, 10);
  return is_near(found.gap, 2 - std::sqrt(2.0)) && is_near(found.normal.x, 1) &&
         separation_of(one, corner).gap > 0;
}

bool a_corner_touches_where_it_is() {
  const Outline one = rectangle(2, 2);
  const Outline corner = placed(rectangle(2, 2), {1 + std::sqrt(2.0) - 0.1, 0.3}, std::atan(1.0));
  const Separation found = separation_of(one, corner);
  return is_near(found.gap, -0.1) && is_near(found.point.y, 0.3) && is_near(found.point.x, 0.95);
}

bool a_hull_has_its_corners_only() {
  const PlaneVector points[] = {{0, 0}, {1, 0}, {0.5, 0.5}, {1, 1}, {0, 1}, {0.5, 0}, {0, 0}, {1, 1}};
  const Outline hull = hull_of(points);
  double area = 0;
  for (std::size_t i = 0; i < hull.count; ++i)
    area += cross(hull.corners[i], hull.corners[(i + 1) % hull.count]) / 2;
  return hull.count == 4 && is_near(area, 1) && hull_of({}).count == 0 &&
         hull_of(std::span(points).first(1)).count == 1;
}

bool cutting_leaves_what_is_inside() {
  const Outline half = cut_by(rectangle(2, 2), {0.25, 0}, {1, 0});
  const Extent x = extent_along(half, {1, 0});
  const Extent y = extent_along(half, {0, 1});
  return is_near(x.low, -1) && is_near(x.high, 0.25) && is_near(y.high - y.low, 2) &&
         cut_by(rectangle(2, 2), {-2, 0}, {1, 0}).count == 0;
}

bool gyration_is_that_of_the_textbook() {
  return is_near(square_of_gyration(rectangle(0.3, 0.4)), 0.25 / 12) &&
         is_near(square_of_gyration(circle(2)), 2, 0.03);
}

bool a_finger_is_cut_at_heights() {
  const HandModel hand;
  Eigen::Isometry3d tool = Eigen::Isometry3d::Identity();
  tool.linear() = turn_about(Eigen::Vector3d::UnitX(), std::acos(-1.0));
  tool.translation() = Eigen::Vector3d(0.4, 0, 0.17);
  const Solid finger(corners_of(hand_boxes(hand, 0.04)[0], tool));
  if (!is_near(finger.low(), 0.01, 1e-9) || !is_near(finger.high(), 0.06, 1e-9)) return false;
  const Outline section = finger.section(0, 0.02);
  const Extent x = extent_along(section, {1, 0});
  const Extent y = extent_along(section, {0, 1});
  // The tool's y points the other way in a hand that points downwards.
  return is_near(x.low, 0.39, 1e-9) && is_near(x.high, 0.41, 1e-9) && is_near(y.low, -0.028, 1e-9) &&
         is_near(y.high, -0.02, 1e-9) && finger.section(0, 0.005).count == 0;
}

bool a_tilted_link_is_cut_at_heights() {
  Capsule link;
  link.to = Eigen::Vector3d(1, 0, 1);
  link.radius = 0.1;
  const Outline section = Solid(link).section(0.5, 0.6);
  const Extent x = extent_along(section, {1, 0});
  const Extent y = extent_along(section, {0, 1});
  return x.low <= 0.4 && x.low > 0.29 && x.high >= 0.7 && x.high < 0.81 && y.high >= 0.1 && y.high < 0.104 &&
         Solid(link).section(1.2, 1.3).count == 0;
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(judged<squares_overlap_by_their_least_way_out>),
      cmocka_unit_test(judged<what_is_apart_has_a_gap>),
      cmocka_unit_test(judged<a_corner_touches_where_it_is>),
      cmocka_unit_test(judged<a_hull_has_its_corners_only>),
      cmocka_unit_test(judged<cutting_leaves_what_is_inside>),
      cmocka_unit_test(judged<gyration_is_that_of_the_textbook>),
      cmocka_unit_test(judged<a_finger_is_cut_at_heights>),
      cmocka_unit_test(judged<a_tilted_link_is_cut_at_heights>),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
