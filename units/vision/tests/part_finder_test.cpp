#include "units/vision/part_finder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "tests/cmocka.hpp"
#include "units/vision/tests/drawn_table.hpp"
#include "units/vision/tests/light_meter.hpp"

namespace flexrf::part_finder_test {
namespace {

using namespace flexrf::user;

constexpr std::size_t block = 0;
constexpr std::size_t disc = 1;
constexpr std::size_t hexagon = 2;
constexpr std::size_t bracket = 3;

struct World {
  explicit World(const flexrf::Pose& tool = tool_above(0.45, 0, 0.45)) : table(tool) {
    finder.prepare(known_parts(), known_table_colour(), 0.4);
  }
  void put(std::size_t kind, const OutlinePose& pose) { table.put(known_parts()[kind], pose); }
  std::span<const Finding> find(const PixelRectangle& rectangle, double noise = 4,
                                const Finding& expected = {}, const PixelRectangle& blind = {}) {
    const PictureView picture = table.picture(noise);
    light.look(picture, blind);
    light.tell(finder);
    Glance at = expected.kind == no_kind ? finder.glance(picture, rectangle, blind) : Glance::none(rectangle);
    if (at.is_cut) at = finder.glance_around(picture, at, blind);
    return finder.measure(picture, at, blind, table.view(), expected, {});
  }

  /// All around a place of so many m, as a hand needs it that is not turned.
  std::span<const Finding> find_all(const Eigen::Vector2d& middle, double size, double noise = 4) {
    const PictureView picture = table.picture(noise);
    light.look(picture);
    light.tell(finder);
    std::array<Eigen::Vector2d, 4> place;
    const double half = size / 2;
    const std::array<Eigen::Vector2d, 4> corners{
        {{-half, -half}, {half, -half}, {half, half}, {-half, half}}};
    for (std::size_t i = 0; i < place.size(); ++i) {
      const Eigen::Vector2d at = middle + corners[i];
      table.view().to_picture({at.x(), at.y(), 0}, place[i]);
    }
    return finder.measure_all(picture, table.around(middle, size + 0.03), {}, table.view(), {}, place);
  }

  DrawnTable table;
  PartFinder finder;
  LightMeter light;
};

double position_error(const Finding& finding, const OutlinePose& pose) {
  return (finding.pose.position - pose.position).norm();
}
double angle_error(const Finding& finding, const OutlinePose& pose) {
  return std::abs(within_symmetry(finding.pose.angle - pose.angle, known_parts()[finding.kind].symmetry));
}

/// The finding of this kind nearest to the pose is within 1 mm and 2 degrees.
bool is_found(std::span<const Finding> findings, std::size_t kind, const OutlinePose& pose) {
  for (const Finding& finding : findings)
    if (finding.found == VisualClass::target && finding.kind == kind &&
        position_error(finding, pose) < 0.001 && angle_error(finding, pose) < 2 * degree)
      return true;
  print_message("%s at %.4f %.4f %.1f, of %zu findings:\n", known_parts()[kind].name.data(),
                pose.position.x(), pose.position.y(), pose.angle / degree, findings.size());
  for (const Finding& finding : findings)
    print_message("  class %d kind %d at %.4f %.4f %.1f, residual %.5f, support %.2f\n",
                  static_cast<int>(finding.found), finding.kind, finding.pose.position.x(),
                  finding.pose.position.y(), finding.pose.angle / degree, finding.residual, finding.support);
  return false;
}

bool a_single_part_is_measured(std::size_t kind, const flexrf::Pose& tool) {
  bool all = true;
  for (int i = 0; i < 6; ++i) {
    const auto world = std::make_unique<World>(tool);
    const OutlinePose pose{{0.36 + 0.035 * i, -0.09 + 0.031 * i}, (-150 + 57 * i) * degree};
    world->put(kind, pose);
    // Not quite in the middle, as attention's windows.
    const auto findings =
        world->find(world->table.around(pose.position + Eigen::Vector2d(0.008, -0.006), 0.1));
    all = is_found(findings, kind, pose) && findings.size() == 1 && all;
  }
  return all;
}

bool what_lies_across_the_border_is_brought_to_the_middle() {
  const auto world = std::make_unique<World>();
  const OutlinePose pose{{0.47, 0.03}, 0.5};
  world->put(bracket, pose);
  return is_found(world->find(world->table.around({0.44, 0.03}, 0.06)), bracket, pose);
}

bool two_that_touch_are_told_apart(std::size_t kind, const OutlinePose& one, const OutlinePose& other) {
  const auto world = std::make_unique<World>();
  world->put(kind, one);
  world->put(kind, other);
  const Eigen::Vector2d middle = (one.position + other.position) / 2;
  const auto findings = world->find(world->table.around(middle, 0.13));
  return is_found(findings, kind, one) && is_found(findings, kind, other);
}

/// The second beside the first, in its frame, and turned.
OutlinePose beside(const OutlinePose& one, double x, double y, double turn) {
  const Eigen::Rotation2Dd rotation(one.angle);
  return {one.position + rotation * Eigen::Vector2d(x, y), one.angle + turn};
}

bool kinds_that_touch_are_told_apart() {
  const auto world = std::make_unique<World>();
  const OutlinePose one{{0.44, 0.0}, 0.4};
  const OutlinePose other = beside(one, 0.045, 0.0, 0);
  world->put(block, one);
  world->put(disc, other);
  const auto findings = world->find(world->table.around((one.position + other.position) / 2, 0.12));
  return is_found(findings, block, one) && is_found(findings, disc, other);
}

bool a_part_that_is_partly_hidden_is_measured() {
  const auto world = std::make_unique<World>();
  const OutlinePose pose{{0.45, 0.0}, 0.6};
  world->put(block, pose);
  // A dark box stands at its end and hides a quarter of it.
  world->table.put(rectangle_of_tests(0.05, 0.05, 0.027, {70, 70, 75}),
                   {pose.position + Eigen::Rotation2Dd(pose.angle) * Eigen::Vector2d(0.037, 0), pose.angle});
  return is_found(world->find(world->table.around(pose.position, 0.12)), block, pose);
}

bool too_little_of_a_part_is_nothing() {
  const auto world = std::make_unique<World>();
  const OutlinePose pose{{0.45, 0.0}, 0};
  world->put(block, pose);
  world->table.put(rectangle_of_tests(0.06, 0.05, 0.027, {70, 70, 75}),
                   {pose.position + Eigen::Vector2d(0.016, 0), 0});
  for (const Finding& finding : world->find(world->table.around(pose.position, 0.12)))
    if (finding.found == VisualClass::target) return false;
  return true;
}

/// Wherever it stands, and however high it is, of what obstacles there are: its foot is where it is seen, not
/// where its image would lie on the table.
bool an_obstacle_stands_where_its_foot_is(double height, double most_off) {
  for (const Eigen::Vector2d& place : {Eigen::Vector2d(0.48, 0.04), Eigen::Vector2d(0.36, 0.10),
                                       Eigen::Vector2d(0.53, -0.06), Eigen::Vector2d(0.45, -0.02)}) {
    const auto world = std::make_unique<World>();
    const user::PartModel box = rectangle_of_tests(0.035, 0.035, height, {70, 70, 75});
    world->table.put(box, {place, 0.2});
    const auto findings = world->find(world->table.around(place, 0.12));
    if (findings.size() != 1 || findings[0].found != VisualClass::obstacle || findings[0].kind != no_kind)
      return false;
    const double off = (findings[0].pose.position - place).norm();
    const double larger = findings[0].radius - box.radius;
    if (off < most_off && std::abs(larger) < most_off && findings[0].support > 0.999) continue;
    print_message("height %.3f at %.3f %.3f: off by %.4f, radius by %.4f, support %.3f\n", height, place.x(),
                  place.y(), off, larger, findings[0].support);
    return false;
  }
  return true;
}

/// Of an obstacle that goes on behind the picture's border that is told.
bool a_piece_of_an_obstacle_is_told() {
  const auto world = std::make_unique<World>();
  Eigen::Vector2d place(0, 0);
  world->table.view().to_plane(10, 240, 0, place);
  world->table.put(rectangle_of_tests(0.04, 0.04, 0.08, {70, 70, 75}), {place, 0.2});
  const auto findings = world->find({0, 180, 120, 120});
  return findings.size() == 1 && findings[0].found == VisualClass::obstacle && findings[0].support < 0.95;
}

/// Where nothing is seen a part may go on: what is said of it has to be right, or nothing.
bool the_border_of_what_is_blind_is_no_edge() {
  int found = 0;
  for (int i = 0; i < 12; ++i) {
    const auto world = std::make_unique<World>();
    const double hidden = 0.15 + 0.01 * i;
    const OutlinePose pose{{0.45, 0.0}, i % 2 == 0 ? 0 : 180 * degree};
    world->put(block, pose);
    Eigen::Vector2d at(0, 0);
    world->table.view().to_picture({0.425 + 0.05 * hidden, 0, 0.025}, at);
    const PixelRectangle blind{0, 0, static_cast<int>(at.x()), 480};
    for (const Finding& finding : world->find(world->table.around(pose.position, 0.1), 4, {}, blind)) {
      if (position_error(finding, pose) > 0.002) return false;
      ++found;
    }
  }
  return found > 6;
}

/// A plate of a part's colour, near the lens and half behind the hand.
bool what_the_hand_holds_is_nothing() {
  const auto world = std::make_unique<World>();
  world->table.put(rectangle_of_tests(0.1, 0.1, 0.01, known_parts()[block].colour), {{0.45, 0.0}, 0.2});
  Eigen::Vector2d at(0, 0);
  world->table.view().to_picture({0.43, 0, 0.01}, at);
  const PixelRectangle blind{0, 0, static_cast<int>(at.x()), 480};
  const auto findings = world->find(world->table.around({0.45, 0.0}, 0.15), 4, {}, blind);
  return findings.empty();
}

/// From so near that its top is all that is seen, an obstacle is one, and a part beside it is what it is.
bool the_light_is_not_that_of_an_obstacles_top() {
  const auto world = std::make_unique<World>();
  const OutlinePose pose{{0.47, 0.03}, 0.5};
  world->put(bracket, pose);
  const Eigen::Vector2d place(0.40, -0.03);
  world->table.put(rectangle_of_tests(0.09, 0.09, 0.05, {70, 70, 75}), {place, 0});
  const auto on_top = world->find(world->table.around(place, 0.04));
  const bool is_obstacle = !on_top.empty() && on_top[0].found == VisualClass::obstacle;
  if (on_top.size() > 1 && !is_found(on_top.subspan(1), bracket, pose)) return false;
  return is_obstacle && is_found(world->find(world->table.around(pose.position, 0.03)), bracket, pose);
}

/// Of a part's colour, and not its outline.
bool a_blue_plate_is_an_obstacle() {
  const auto world = std::make_unique<World>();
  world->table.put(rectangle_of_tests(0.1, 0.1, 0.01, known_parts()[block].colour), {{0.45, 0.0}, 0.2});
  const auto findings = world->find(world->table.around({0.45, 0.0}, 0.15));
  return findings.size() == 1 && findings[0].found == VisualClass::obstacle;
}

bool nothing_is_found_where_nothing_is() {
  const auto world = std::make_unique<World>();
  const bool bare = world->find({100, 100, 120, 120}).empty();
  const bool outside = world->find({700, 500, 100, 100}).empty() && world->finder.pixels() == 0;
  world->table.fill({0, 0, 0});
  for (const Finding& finding : world->find({100, 100, 120, 120}, 0))
    if (finding.found == VisualClass::target) return false;
  return bare && outside;
}

bool noise_ends_and_is_no_part() {
  const auto world = std::make_unique<World>();
  for (int i = 0; i < 4; ++i)
    for (const Finding& finding : world->find({80 * i, 60 * i, 160, 160}, 255))
      if (finding.found == VisualClass::target) return false;
  return true;
}

const user::PartModel post = rectangle_of_tests(0.04, 0.04, 0.09, {70, 70, 75});
const Eigen::Vector2d looked_at(0.45, 0);

bool a_bare_place_is_told() {
  const auto world = std::make_unique<World>();
  return world->find_all(looked_at, 0.12).empty() && world->finder.is_complete();
}

/// In its middle, and where the border cuts it: more of it lies in the picture's rectangle than in the place.
bool what_stands_in_a_place_is_told() {
  for (const double beside : {0.0, 0.03, 0.06, 0.075}) {
    const auto world = std::make_unique<World>();
    world->table.put(post, {looked_at + Eigen::Vector2d(beside, 0), 0});
    world->put(disc, {looked_at + Eigen::Vector2d(-0.035, 0.035), 0});
    const auto findings = world->find_all(looked_at, 0.12);
    const bool tells_post = std::any_of(findings.begin(), findings.end(), [&](const Finding& finding) {
      return finding.found == VisualClass::obstacle &&
             (finding.pose.position - looked_at - Eigen::Vector2d(beside, 0)).norm() < finding.radius + 0.02;
    });
    const bool tells_disc = std::any_of(findings.begin(), findings.end(), [](const Finding& finding) {
      return finding.found == VisualClass::target && finding.kind == disc;
    });
    if (!tells_post || !tells_disc || !world->finder.is_complete()) return false;
  }
  return true;
}

/// Nine things are more than a list holds, and in the dark, or in noise, nobody can tell.
bool what_cannot_be_told_is_said_so() {
  const auto crowded = std::make_unique<World>();
  for (int i = 0; i < 9; ++i)
    crowded->table.put(rectangle_of_tests(0.018, 0.018, 0.02, {70, 70, 75}),
                       {looked_at + Eigen::Vector2d(0.045 * (i % 3 - 1), 0.045 * (i / 3 - 1)), 0});
  crowded->find_all(looked_at, 0.14);
  if (crowded->finder.is_complete()) return false;
  const auto dark = std::make_unique<World>();
  dark->table.fill({0, 0, 0});
  dark->find_all(looked_at, 0.12, 0);
  if (dark->finder.is_complete()) return false;
  const auto noisy = std::make_unique<World>();
  noisy->find_all(looked_at, 0.12, 255);
  return !noisy->finder.is_complete();
}

/// What is expected helps, and where it is wrong it does no harm.
bool expectations_do_no_harm() {
  const auto world = std::make_unique<World>();
  const OutlinePose pose{{0.47, 0.03}, 0.5};
  world->put(bracket, pose);
  Finding expected;
  expected.kind = bracket;
  expected.pose = {pose.position + Eigen::Vector2d(0.003, -0.002), pose.angle + 0.05};
  const bool near =
      is_found(world->find(world->table.around(pose.position, 0.09), 4, expected), bracket, pose);
  expected.pose.angle += 3;
  const bool turned =
      is_found(world->find(world->table.around(pose.position, 0.09), 4, expected), bracket, pose);
  expected.kind = disc;
  const bool other =
      is_found(world->find(world->table.around(pose.position, 0.09), 4, expected), bracket, pose);
  return near && turned && other;
}

const flexrf::Pose above = tool_above(0.45, 0, 0.45);
const flexrf::Pose tilted = tool_above(0.45, 0.08, 0.42, -10 * degree);

void blocks(void**) {
  assert_true(a_single_part_is_measured(block, above));
  assert_true(a_single_part_is_measured(block, tilted));
}
void discs(void**) {
  assert_true(a_single_part_is_measured(disc, above));
}
void hexagons(void**) {
  assert_true(a_single_part_is_measured(hexagon, above));
}
void brackets(void**) {
  assert_true(a_single_part_is_measured(bracket, above));
  assert_true(a_single_part_is_measured(bracket, tilted));
}
void across_the_border(void**) {
  assert_true(what_lies_across_the_border_is_brought_to_the_middle());
}
void touching_blocks(void**) {
  const OutlinePose one{{0.44, -0.01}, 0.3};
  assert_true(two_that_touch_are_told_apart(block, one, beside(one, 0.050, 0.010, 0)));
  assert_true(two_that_touch_are_told_apart(block, one, beside(one, 0.040, 0.005, 90 * degree)));
}
void touching_discs(void**) {
  assert_true(two_that_touch_are_told_apart(disc, {{0.43, 0.01}, 0}, {{0.43 + 0.0396, 0.01}, 0}));
}
void touching_hexagons(void**) {
  const OutlinePose one{{0.44, -0.01}, 0.2};
  assert_true(two_that_touch_are_told_apart(hexagon, one, beside(one, 0.036 * 0.8660254, 0.018, 0)));
}
void touching_brackets(void**) {
  const OutlinePose one{{0.44, -0.01}, 0.2};
  assert_true(two_that_touch_are_told_apart(bracket, one, beside(one, -0.040, -0.004, 180 * degree)));
}
void touching_kinds(void**) {
  assert_true(kinds_that_touch_are_told_apart());
}
void hidden(void**) {
  assert_true(a_part_that_is_partly_hidden_is_measured());
  assert_true(too_little_of_a_part_is_nothing());
}
void obstacles(void**) {
  assert_true(an_obstacle_stands_where_its_foot_is(0.09, 0.003));
  assert_true(an_obstacle_stands_where_its_foot_is(0.06, 0.008));
  assert_true(an_obstacle_stands_where_its_foot_is(0.12, 0.010));
  assert_true(a_piece_of_an_obstacle_is_told());
  assert_true(a_blue_plate_is_an_obstacle());
}
void blind(void**) {
  assert_true(the_border_of_what_is_blind_is_no_edge());
  assert_true(what_the_hand_holds_is_nothing());
}
void light(void**) {
  assert_true(the_light_is_not_that_of_an_obstacles_top());
}
void nothing(void**) {
  assert_true(nothing_is_found_where_nothing_is());
}
void noise(void**) {
  assert_true(noise_ends_and_is_no_part());
}
void places(void**) {
  assert_true(a_bare_place_is_told());
  assert_true(what_stands_in_a_place_is_told());
  assert_true(what_cannot_be_told_is_said_so());
}
void expectations(void**) {
  assert_true(expectations_do_no_harm());
}

}  // namespace
}  // namespace flexrf::part_finder_test

int main() {
  using namespace flexrf::part_finder_test;
  const CMUnitTest tests[] = {cmocka_unit_test(blocks),
                              cmocka_unit_test(discs),
                              cmocka_unit_test(hexagons),
                              cmocka_unit_test(brackets),
                              cmocka_unit_test(across_the_border),
                              cmocka_unit_test(touching_blocks),
                              cmocka_unit_test(touching_discs),
                              cmocka_unit_test(touching_hexagons),
                              cmocka_unit_test(touching_brackets),
                              cmocka_unit_test(touching_kinds),
                              cmocka_unit_test(hidden),
                              cmocka_unit_test(obstacles),
                              cmocka_unit_test(blind),
                              cmocka_unit_test(light),
                              cmocka_unit_test(nothing),
                              cmocka_unit_test(noise),
                              cmocka_unit_test(places),
                              cmocka_unit_test(expectations)};
  return cmocka_run_group_tests_name("part finder", tests, nullptr, nullptr);
}
