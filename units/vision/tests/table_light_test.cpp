#include "units/vision/table_light.hpp"

#include <cmath>
#include <memory>

#include "tests/cmocka.hpp"
#include "units/vision/tests/drawn_table.hpp"

namespace flexrf::table_light_test {
namespace {

using namespace flexrf::user;

constexpr SurfaceColour grey{70, 70, 75};

struct World {
  DrawnTable table;
  ColourClasses classes;
  TableLight light;

  World() { classes.prepare(known_parts(), known_table_colour(), 0.4); }
  bool look(const PixelRectangle& blind = {}) { return light.look(table.picture(3), blind, classes); }
  void light_up(const std::array<double, 3>& colour) {
    table.light = colour;
    table.clear();
  }
  /// The light that is taken is the one that there is, to 2 %.
  bool is_right() const {
    for (std::size_t i = 0; i < 3; ++i)
      if (std::abs(light.balance().gain[i] / 256.0 * table.light[i] - 1) > 0.02) return false;
    return true;
  }
  /// Covers so much of the picture from its left, with something that lies flat.
  void cover(double share, SurfaceColour colour) {
    const auto last = static_cast<int>(640 * share);
    Eigen::Vector2d from(0, 0);
    Eigen::Vector2d to(0, 0);
    table.view().to_plane(0, 240, 0, from);
    table.view().to_plane(last, 240, 0, to);
    user::PartModel sheet = rectangle_of_tests((to - from).norm(), 1.0, 0, colour);
    sheet.radius = 0.3;
    table.put(sheet, {(from + to) / 2, 0});
  }
};

void any_light_is_told(void**) {
  for (const std::array<double, 3> colour :
       {std::array<double, 3>{1, 1, 1}, {0.3, 0.3, 0.3}, {1.5, 1.5, 1.5}, {1.1, 1.0, 0.8}}) {
    const auto world = std::make_unique<World>();
    world->light_up(colour);
    assert_true(world->look());
    assert_true(world->is_right());
  }
}

/// A shadow, parts and obstacles on four fifths of a picture.
void the_table_need_not_be_most_of_it(void**) {
  const auto world = std::make_unique<World>();
  world->light_up({0.8, 0.8, 0.8});
  world->cover(0.8, {78, 75, 70});
  assert_true(world->look());
  assert_true(world->is_right());
  world->cover(0.8, grey);
  assert_true(world->look());
  assert_true(world->is_right());
  world->cover(0.8, known_parts()[0].colour);
  assert_true(world->look());
  assert_true(world->is_right());
}

/// Nothing but a grey top, or but a shadow in nearly half of the picture.
void where_it_is_not_seen_the_light_is_as_it_was(void**) {
  const auto world = std::make_unique<World>();
  assert_true(world->look());
  const WhiteBalance before = world->light.balance();
  world->table.fill(known_parts()[3].colour);
  world->cover(0.45, grey);
  assert_false(world->look());
  assert_true(world->light.balance().gain == before.gain);
  world->table.fill(known_parts()[3].colour);
  assert_false(world->look());
  assert_true(world->light.balance().gain == before.gain);
}

/// The first picture is of a shadow; those behind it are not.
void what_was_wrong_does_not_last(void**) {
  const auto world = std::make_unique<World>();
  world->table.fill({78, 75, 70});
  assert_true(world->look());
  world->light_up({1, 1, 1});
  assert_true(world->look());
  assert_true(world->is_right());
  // A light that is turned down is one when it dims most of a picture.
  world->light_up({0.5, 0.5, 0.5});
  assert_true(world->look());
  assert_true(world->is_right());
}

void what_is_blind_is_not_looked_at(void**) {
  const auto world = std::make_unique<World>();
  world->cover(0.96, known_parts()[1].colour);
  assert_false(world->look());
  assert_true(world->look({0, 0, 614, 480}));
}

void without_light_there_is_none(void**) {
  const auto world = std::make_unique<World>();
  world->table.fill({2, 2, 2});
  assert_false(world->look());
  world->table.fill({255, 255, 255});
  assert_false(world->look());
}

}  // namespace
}  // namespace flexrf::table_light_test

int main() {
  using namespace flexrf::table_light_test;
  const CMUnitTest tests[] = {cmocka_unit_test(any_light_is_told),
                              cmocka_unit_test(the_table_need_not_be_most_of_it),
                              cmocka_unit_test(where_it_is_not_seen_the_light_is_as_it_was),
                              cmocka_unit_test(what_was_wrong_does_not_last),
                              cmocka_unit_test(what_is_blind_is_not_looked_at),
                              cmocka_unit_test(without_light_there_is_none)};
  return cmocka_run_group_tests_name("table light", tests, nullptr, nullptr);
}
