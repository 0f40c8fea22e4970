#include "hal/scene/world/tabletop_world.hpp"

#include <algorithm>
#include <cstring>

#include "hal/scene/world/table_layout.hpp"
#include "hal/scene/world/tests/world_bench.hpp"
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;

// Each case runs in here, so that a failing assertion jumps over no destructor.
template <bool (*Run)()>
void judged(void**) {
  assert_true(Run());
}

SceneBody post_at(double x, double y, double diameter = 0.04) {
  SceneBody post{};
  post.kind = SceneKind::post;
  post.position = {x, y, 0};
  post.size = {diameter, diameter, 0.09};
  return post;
}

double least_gap(const SceneState& state, std::size_t part) {
  double least = 1;
  const Footprint one = footprint_of(state.parts[part]);
  for (std::size_t i = 0; i < most_parts; ++i)
    if (i != part) least = std::min(least, separation_of(one, footprint_of(state.parts[i]), 1).gap);
  return least;
}

/// A ray from well above and behind the arm's side meets an obstacle before the part.
bool is_partly_hidden(const SceneState& state, std::size_t part) {
  bool hidden = false;
  bool seen = false;
  const Footprint one = footprint_of(state.parts[part]);
  for (const Outline& piece : one.pieces.all()) {
    for (const PlaneVector corner : piece.all()) {
      bool covered = false;
      for (const SceneBody& obstacle : state.obstacles) {
        const Footprint other = footprint_of(obstacle);
        if (!other.exists()) continue;
        // Half way to an eye that looks down by 45 degrees, what is so high covers what is so far behind.
        for (double way = 0; way < obstacle.size[2]; way += 0.002) {
          const Outline point = placed(rectangle(1e-4, 1e-4), {corner.x - way, corner.y}, 0);
          covered = covered || separation_of(point, other, 0).gap < 0;
        }
      }
      hidden = hidden || covered;
      seen = seen || !covered;
    }
  }
  return hidden && seen;
}

bool a_table_is_laid_as_promised() {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    TabletopWorld world;
    world.begin(HandModel{}, seed);
    const SceneState& state = world.state();
    if (!is_apart(state, 0) || world.counts().parts_on_table != 12 || world.counts().obstacles != 4)
      return false;
    std::array<int, part_kinds> kinds{};
    int touching = 0;
    int hidden = 0;
    for (std::size_t i = 0; i < most_parts; ++i) {
      const SceneBody& part = state.parts[i];
      for (std::size_t kind = 0; kind < part_kinds; ++kind)
        if (part_catalogue[kind].kind == part.kind) ++kinds[kind];
      if (part.position[0] < 0.3 || part.position[0] > 0.6 || std::abs(part.position[1]) > 0.25) return false;
      if (least_gap(state, i) < 1e-4) ++touching;
      if (is_partly_hidden(state, i)) ++hidden;
    }
    if (kinds != std::array<int, part_kinds>{3, 3, 3, 3} || touching < 3 || touching + hidden < 4)
      return false;
    for (std::size_t i = 0; i < 4; ++i)
      if (state.obstacles[i].size[2] < 0.06 || state.obstacles[i].size[2] > 0.12) return false;
  }
  return true;
}

bool the_seed_lays_the_table() {
  TabletopWorld one;
  TabletopWorld same;
  TabletopWorld other;
  one.begin(HandModel{}, 7);
  same.begin(HandModel{}, 7);
  other.begin(HandModel{}, 8);
  const auto is_same = [](const TabletopWorld& left, const TabletopWorld& right) {
    for (std::size_t i = 0; i < most_parts; ++i)
      if (left.state().parts[i].position != right.state().parts[i].position ||
          left.state().parts[i].angle != right.state().parts[i].angle)
        return false;
    return true;
  };
  if (!is_same(one, same) || is_same(one, other)) return false;
  one.lay_table();
  const bool is_new = !is_same(one, same);
  same.lay_table();
  return is_new && is_same(one, same);
}

/// Wherever the hand is, nothing is laid into it: it touches nothing then, and moves nothing.
bool a_table_is_laid_around_the_hand() {
  for (int i = 0; i < 30; ++i) {
    WorldBench bench;
    bench.put_parts({});
    bench.jump(0.32 + 0.008 * i, 0.2 - 0.013 * i, 0.01, 0.06, 0.2 * i);
    const auto before = bench.world.counts();
    bench.world.lay_table();
    bench.move(0.32 + 0.008 * i, 0.2 - 0.013 * i, 0.01, 0.06, 0.2 * i);
    const auto& after = bench.world.counts();
    if (after.contacts != before.contacts || after.touches != before.touches || after.parts_on_table < 11)
      return false;
  }
  return true;
}

// Else there would lie, in the end, nothing but what a hand cannot take.
bool what_comes_anew_stands_where_a_hand_has_room() {
  SceneRandom random;
  random.seed(5);
  for (int table = 0; table < 20; ++table) {
    SceneState state{};
    lay_table(state, random, {});
    for (std::size_t i = 0; i < most_parts; ++i) {
      if (!lay_part(state, i, {}, random)) return false;
      const Footprint part = footprint_of(state.parts[i]);
      for (const SceneBody& obstacle : state.obstacles)
        if (separation_of(part, footprint_of(obstacle), 1).gap < 0.045) return false;
      if (least_gap(state, i) < 0.006) return false;
    }
  }
  return true;
}

// Closed fingers, 16 mm along y and 20 along x, come from the arm's side against the middle of a block.
bool what_is_touched_moves() {
  WorldBench bench;
  bench.put_parts({part_at(SceneKind::block, {0.40, 0}, 0), part_at(SceneKind::disc, {0.50, 0.2}, 0)});
  bench.jump(0.30, 0, 0.005, 0);
  if (!bench.is_at(0, 0.40, 0)) return false;
  bench.move(0.40, 0, 0.005, 0);
  // 10 mm of finger and 25 of block.
  return bench.is_at(0, 0.435, 0, 1e-5) && std::abs(bench.part(0).angle) < 1e-6 &&
         bench.is_at(1, 0.50, 0.2) && bench.world.counts().touches == 1 && bench.world.counts().contacts == 0;
}

bool pushed_beside_its_middle_it_turns() {
  WorldBench bench;
  bench.put_parts({part_at(SceneKind::block, {0.40, 0}, half_turn / 2)});
  bench.jump(0.34, 0.03, 0.005, 0);
  bench.move(0.40, 0.03, 0.005, 0);
  // To the left of its middle, so it turns to the right, and stays behind what a push in the middle would do.
  const SceneBody& part = bench.part(0);
  return part.angle < half_turn / 2 - 0.1 && part.position[0] > 0.401 && part.position[0] < 0.425;
}

bool pushed_parts_push_others() {
  WorldBench bench;
  bench.put_parts({part_at(SceneKind::block, {0.40, 0}, 0), part_at(SceneKind::block, {0.46, 0}, 0),
                   part_at(SceneKind::bracket, {0.40, 0.1}, 0)});
  bench.jump(0.30, 0, 0.005, 0);
  bench.move(0.42, 0, 0.005, 0);
  return bench.is_at(0, 0.455, 0, 1e-4) && bench.is_at(1, 0.505, 0, 1e-4) && bench.is_at(2, 0.40, 0.1) &&
         is_apart(bench.world.state()) && bench.world.counts().touches == 1;
}

bool what_stands_behind_is_not_run_through() {
  WorldBench bench;
  bench.put_parts({part_at(SceneKind::block, {0.40, 0}, 0), part_at(SceneKind::disc, {0.47, 0.0}, 0)},
                  {post_at(0.52, 0, 0.06)});
  bench.jump(0.30, 0, 0.005, 0);
  bench.move(0.41, 0, 0.005, 0);
  // Pressed against the post: whatever overlaps the fingers, parts overlap nothing.
  return is_apart(bench.world.state(), 5e-5) && bench.world.counts().contacts == 0;
}

bool links_push_too() {
  WorldBench bench;
  bench.put_parts({part_at(SceneKind::disc, {0.40, 0}, 0)}, {post_at(0.6, 0)});
  HandState hand;
  hand.tool = hand_at(0.2, 0.4, 0.5);
  hand.opening = 0.08;
  Capsule links[1];
  links[0].radius = 0.05;
  hand.links = links;
  for (int i = 0; i <= 50; ++i) {
    const double x = 0.3 + 0.002 * i;
    links[0].from = Eigen::Vector3d(x, -0.5, 0.06);
    links[0].to = Eigen::Vector3d(x, 0.5, 0.06);
    bench.world.step(hand);
  }
  const double moved = bench.part(0).position[0];
  if (moved < 0.46 || moved > 0.475 || bench.world.counts().contacts != 0) return false;
  // On to the post, and down to the table.
  for (int i = 0; i < 100; ++i) {
    links[0].from.x() += 0.002;
    links[0].to.x() += 0.002;
    bench.world.step(hand);
  }
  if (bench.world.counts().contacts != 1) return false;
  links[0].from.z() = links[0].to.z() = 0.04;
  bench.world.step(hand);
  return bench.world.counts().contacts == 2;
}

bool what_is_over_a_part_leaves_it_alone() {
  WorldBench bench;
  bench.put_parts({part_at(SceneKind::block, {0.40, 0}, 0)});
  bench.jump(0.30, 0, 0.026, 0);
  bench.move(0.50, 0, 0.026, 0);
  return bench.is_at(0, 0.40, 0) && bench.world.counts().touches == 0;
}

bool contacts_are_counted_once_each() {
  WorldBench bench;
  bench.put_parts({}, {post_at(0.40, 0)});
  // The palm is above the post.
  bench.jump(0.30, 0, 0.045, 0.02);
  bench.move(0.40, 0, 0.045, 0.02);
  const std::uint64_t once = bench.world.counts().contacts;  // both fingers
  bench.move(0.30, 0, 0.045, 0.02);
  bench.move(0.30, 0, -0.002, 0.02);
  const std::uint64_t table = bench.world.counts().contacts;
  bench.move(0.30, 0, -0.002, 0.02);
  return once == 2 && table == 4 && bench.world.counts().contacts == 4;
}

bool a_person_does_as_asked() {
  WorldBench bench;
  bench.put_parts({part_at(SceneKind::block, {0.40, 0}, 0), part_at(SceneKind::disc, {0.46, 0}, 0)});
  TabletopWorld& world = bench.world;
  if (world.push_part(0, {0.38, 0}, 0.03, 0) != nullptr) return false;
  if (!bench.is_at(0, 0.43, 0, 1e-6) || bench.part(1).position[0] < 0.4749 || world.counts().touches != 0)
    return false;
  if (world.push_part(2, {}, 0.02, half_turn / 2) != nullptr || !(bench.part(1).position[1] > 0.0199))
    return false;
  if (world.push_part(7, {}, 0.02, 0) == nullptr) return false;
  bench.jump(0.3, 0.2, 0.05, 0.02);
  if (world.add_obstacle({0.3, 0.2}) == nullptr || world.counts().contacts != 0) return false;
  bench.jump(0.3, 0.2, 0.2, 0.02);
  if (world.add_obstacle({0.43, 0}) == nullptr || world.remove_obstacles() == nullptr) return false;
  for (int i = 0; i < 4; ++i)
    if (world.add_obstacle({0.3, -0.2 + 0.1 * i}) != nullptr) return false;
  if (world.add_obstacle({0.6, 0.2}) == nullptr || world.counts().obstacles != 4) return false;
  if (world.remove_obstacles() != nullptr || world.counts().obstacles != 0) return false;
  world.cover_lens(true);
  world.set_light(1.5, 0, half_turn / 4);
  world.set_light_tint({0.2, 0, -0.3});
  const SceneState& state = world.state();
  return state.lens_covered && state.light_intensity == 1.5 && state.light_tint[0] == 0.2 &&
         state.light_tint[2] == -0.3 && std::abs(state.light[2] - std::sqrt(0.5)) < 1e-12 &&
         state.light[1] == 0;
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(judged<a_table_is_laid_as_promised>),
      cmocka_unit_test(judged<the_seed_lays_the_table>),
      cmocka_unit_test(judged<a_table_is_laid_around_the_hand>),
      cmocka_unit_test(judged<what_comes_anew_stands_where_a_hand_has_room>),
      cmocka_unit_test(judged<what_is_touched_moves>),
      cmocka_unit_test(judged<pushed_beside_its_middle_it_turns>),
      cmocka_unit_test(judged<pushed_parts_push_others>),
      cmocka_unit_test(judged<what_stands_behind_is_not_run_through>),
      cmocka_unit_test(judged<links_push_too>),
      cmocka_unit_test(judged<what_is_over_a_part_leaves_it_alone>),
      cmocka_unit_test(judged<contacts_are_counted_once_each>),
      cmocka_unit_test(judged<a_person_does_as_asked>),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
