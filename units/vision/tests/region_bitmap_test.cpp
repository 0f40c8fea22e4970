#include "units/vision/region_bitmap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "tests/cmocka.hpp"
#include "units/vision/table_light.hpp"
#include "units/vision/tests/drawn_table.hpp"

namespace flexrf::region_bitmap_test {
namespace {

using namespace flexrf::user;

constexpr PixelRectangle nowhere{};

struct World {
  DrawnTable table;
  ColourClasses classes;
  TableLight light;
  RegionBitmap bitmap;

  World() { classes.prepare(known_parts(), known_table_colour(), 0.4); }
  void take(const PixelRectangle& rectangle, const PixelRectangle& blind = nowhere, double noise = 0) {
    const PictureView picture = table.picture(noise);
    light.look(picture, nowhere, classes);
    bitmap.take(picture, rectangle, blind, classes, light.balance());
  }
  std::size_t blobs_of(std::uint8_t pixel_class) const {
    std::size_t count = 0;
    for (const Blob& blob : bitmap.blobs())
      if (blob.pixel_class == pixel_class) ++count;
    return count;
  }
};

std::uint8_t class_of(std::size_t kind) {
  return static_cast<std::uint8_t>(class_first_part + kind);
}

bool each_kind_is_told_by_its_colour(std::array<double, 3> light, double noise) {
  const auto world = std::make_unique<World>();
  world->table.light = light;
  world->table.clear();
  const auto parts = known_parts();
  for (std::size_t kind = 0; kind < parts.size(); ++kind)
    world->table.put(parts[kind], {{0.36 + 0.06 * static_cast<double>(kind), 0.01}, 0.3});
  for (std::size_t kind = 0; kind < parts.size(); ++kind) {
    world->take(world->table.around({0.36 + 0.06 * static_cast<double>(kind), 0.01}, 0.058), nowhere, noise);
    if (world->blobs_of(class_of(kind)) != 1 || world->bitmap.blobs()[0].pixel_class != class_of(kind))
      return false;
  }
  return true;
}

bool a_bare_table_has_no_blobs(double light) {
  const auto world = std::make_unique<World>();
  world->table.light = {light, light, light};
  world->table.clear();
  world->take({200, 100, 140, 140}, nowhere, 6);
  return world->bitmap.blobs().empty();
}

/// A shadow as dark as a grey obstacle is table, the obstacle is foreign, and so is what is darker than a
/// shadow and of the table's colour.
bool shadows_are_no_obstacles(double light) {
  const auto world = std::make_unique<World>();
  world->table.light = {light, light, light};
  world->table.clear();
  const PixelRectangle around = world->table.around({0.45, 0.02}, 0.1);
  world->table.put(rectangle_of_tests(0.04, 0.04, 0, {72, 70, 65}), {{0.45, 0.02}, 0});
  world->take(around, nowhere, 3);
  const bool shadow = world->bitmap.blobs().empty();
  world->table.put(rectangle_of_tests(0.04, 0.04, 0.01, {70, 70, 75}), {{0.45, 0.02}, 0});
  world->take(around, nowhere, 3);
  const bool grey = world->blobs_of(class_foreign) == 1 && world->bitmap.blobs().size() == 1;
  world->table.put(rectangle_of_tests(0.04, 0.04, 0.01, {45, 43, 40}), {{0.45, 0.02}, 0});
  world->take(around, nowhere, 3);
  return shadow && grey && world->blobs_of(class_foreign) == 1;
}

/// A blue part in a shadow: between the two colours there is one as that of a grey obstacle.
bool a_blurred_edge_is_not_foreign() {
  const auto world = std::make_unique<World>();
  world->table.put(rectangle_of_tests(0.12, 0.12, 0, {78, 75, 70}), {{0.45, 0.02}, 0});
  const PixelRectangle around = world->table.around({0.45, 0.02}, 0.1);
  world->table.put(rectangle_of_tests(0.052, 0.032, 0, {70, 80, 110}), {{0.45, 0.02}, 0.4});
  world->table.put(rectangle_of_tests(0.05, 0.03, 0, known_parts()[0].colour), {{0.45, 0.02}, 0.4});
  world->take(around, nowhere, 3);
  return world->blobs_of(class_of(0)) == 1 && world->bitmap.blobs().size() == 1;
}

/// What is as narrow at a border may go on behind it; else it is dropped.
bool a_narrow_strip_is_kept_at_a_border_only() {
  const auto world = std::make_unique<World>();
  const double pixel = 1 / world->table.view().pixels_per_metre({0.45, 0.02, 0});
  world->table.put(rectangle_of_tests(0.06, 2 * pixel, 0, {20, 20, 90}), {{0.45, 0.02}, 0});
  const PixelRectangle around = world->table.around({0.45, 0.02}, 0.1);
  world->take(around);
  const bool dropped = world->bitmap.blobs().empty();
  Eigen::Vector2d on_it(0, 0);
  world->table.view().to_picture({0.45, 0.02, 0}, on_it);
  world->take({around.left, static_cast<int>(on_it.y()), around.width, 60});
  const bool at_the_border = world->blobs_of(class_foreign) == 1;
  world->take(around, {0, 0, 640, static_cast<int>(on_it.y())});
  return dropped && at_the_border && world->blobs_of(class_foreign) == 1;
}

bool what_is_blind_is_not_seen() {
  const auto world = std::make_unique<World>();
  world->table.put(known_parts()[1], {{0.45, 0.02}, 0});
  const PixelRectangle rectangle = world->table.around({0.45, 0.02}, 0.08);
  world->take(rectangle);
  const bool seen = world->bitmap.blobs().size() == 1;
  world->take(rectangle, rectangle);
  return seen && world->bitmap.blobs().empty();
}

bool a_blob_at_the_border_is_cut() {
  const auto world = std::make_unique<World>();
  world->table.put(known_parts()[0], {{0.45, 0.02}, 0});
  const PixelRectangle whole = world->table.around({0.45, 0.02}, 0.1);
  world->take(whole);
  const bool not_cut = !world->bitmap.is_cut(world->bitmap.blobs()[0], world->table.picture());
  world->take({whole.left + whole.width / 2, whole.top, whole.width, whole.height});
  return not_cut && world->bitmap.blobs().size() == 1 &&
         world->bitmap.is_cut(world->bitmap.blobs()[0], world->table.picture());
}

/// A picture of squares, each of the table's or one of two parts' colours: the blobs are those that one finds
/// by walking from square to square.
bool blobs_are_what_hangs_together(std::uint32_t seed) {
  constexpr int squares = 24;
  constexpr int size = 5;  // pixels of a square's side
  constexpr int side = squares * size;
  std::minstd_rand random{seed};
  std::array<int, squares * squares> kinds{};  // 0: the table
  for (int& kind : kinds) kind = static_cast<int>(random() % 4) == 3 ? 0 : static_cast<int>(random() % 3);
  std::vector<std::uint8_t> pixels;
  const auto colour_of = [](int kind) {
    return kind == 0 ? known_table_colour() : known_parts()[static_cast<std::size_t>(kind - 1)].colour;
  };
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const SurfaceColour colour =
          colour_of(kinds[static_cast<std::size_t>(row / size * squares + column / size)]);
      pixels.insert(pixels.end(), {colour.red, colour.green, colour.blue});
    }
  }
  std::vector<int> areas;  // squares of each blob
  std::array<bool, squares * squares> seen{};
  for (std::size_t first = 0; first < kinds.size(); ++first) {
    if (seen[first] || kinds[first] == 0) continue;
    std::vector<std::size_t> found{first};
    seen[first] = true;
    for (std::size_t next = 0; next < found.size(); ++next) {
      const int column = static_cast<int>(found[next]) % squares;
      const int row = static_cast<int>(found[next]) / squares;
      for (const auto& [x, y] :
           {std::pair{column - 1, row}, {column + 1, row}, {column, row - 1}, {column, row + 1}}) {
        if (x < 0 || y < 0 || x == squares || y == squares) continue;
        const auto to = static_cast<std::size_t>(y * squares + x);
        if (seen[to] || kinds[to] != kinds[first]) continue;
        seen[to] = true;
        found.push_back(to);
      }
    }
    areas.push_back(static_cast<int>(found.size()) * size * size);
  }
  std::sort(areas.begin(), areas.end(), std::greater<>{});
  const auto world = std::make_unique<World>();
  world->bitmap.take({pixels.data(), side * 3, side, side}, {0, 0, side, side}, nowhere, world->classes, {});
  const auto blobs = world->bitmap.blobs();
  if (blobs.size() != std::min(areas.size(), RegionBitmap::most_blobs)) return false;
  for (std::size_t i = 0; i < blobs.size(); ++i) {
    int cells = 0;
    for (int row = blobs[i].top; row <= blobs[i].bottom; ++row)
      for (int column = blobs[i].left; column <= blobs[i].right; ++column)
        if (world->bitmap.label(column, row) == blobs[i].label) ++cells;
    if (blobs[i].area != areas[i] || cells != areas[i]) return false;
    if (world->bitmap.label(blobs[i].first_column, blobs[i].top) != blobs[i].label) return false;
  }
  return true;
}

bool any_rectangle_ends_well() {
  const auto world = std::make_unique<World>();
  for (const PixelRectangle rectangle :
       {PixelRectangle{-50, -50, 60, 60}, PixelRectangle{700, 10, 50, 50}, PixelRectangle{0, 0, 0, 0},
        PixelRectangle{10, 10, -5, 20}, PixelRectangle{0, 0, 640, 480}, PixelRectangle{639, 479, 1, 1},
        PixelRectangle{-32768, -32768, 65535, 65535}}) {
    world->take(rectangle, nowhere, 200);
    if (world->bitmap.columns() > RegionBitmap::side || world->bitmap.rows() > RegionBitmap::side ||
        world->bitmap.blobs().size() > RegionBitmap::most_blobs)
      return false;
    for (std::size_t i = 1; i < world->bitmap.blobs().size(); ++i)
      if (world->bitmap.blobs()[i].area > world->bitmap.blobs()[i - 1].area) return false;
  }
  return true;
}

void colours(void**) {
  assert_true(each_kind_is_told_by_its_colour({1, 1, 1}, 0));
  assert_true(each_kind_is_told_by_its_colour({1, 1, 1}, 8));
  assert_true(each_kind_is_told_by_its_colour({0.4, 0.4, 0.4}, 3));
  assert_true(each_kind_is_told_by_its_colour({1.1, 1.0, 0.8}, 3));
}
void bare_table(void**) {
  assert_true(a_bare_table_has_no_blobs(1));
  assert_true(a_bare_table_has_no_blobs(0.4));
}
void shadows(void**) {
  assert_true(shadows_are_no_obstacles(1));
  assert_true(shadows_are_no_obstacles(0.6));
}
void edges(void**) {
  assert_true(a_blurred_edge_is_not_foreign());
  assert_true(a_narrow_strip_is_kept_at_a_border_only());
}
void blind(void**) {
  assert_true(what_is_blind_is_not_seen());
}
void cut(void**) {
  assert_true(a_blob_at_the_border_is_cut());
}
void connected(void**) {
  for (std::uint32_t seed = 1; seed <= 200; ++seed) assert_true(blobs_are_what_hangs_together(seed));
}
void rectangles(void**) {
  assert_true(any_rectangle_ends_well());
}

}  // namespace
}  // namespace flexrf::region_bitmap_test

int main() {
  using namespace flexrf::region_bitmap_test;
  const CMUnitTest tests[] = {cmocka_unit_test(colours),   cmocka_unit_test(bare_table),
                              cmocka_unit_test(shadows),   cmocka_unit_test(edges),
                              cmocka_unit_test(blind),     cmocka_unit_test(cut),
                              cmocka_unit_test(connected), cmocka_unit_test(rectangles)};
  return cmocka_run_group_tests_name("region bitmap", tests, nullptr, nullptr);
}
