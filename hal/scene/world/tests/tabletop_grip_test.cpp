#include "hal/scene/world/tests/world_bench.hpp"
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;

// Each case runs in here, so that a failing assertion jumps over no destructor.
template <bool (*Run)()>
void judged(void**) {
  assert_true(Run());
}

bool is_near(double one, double other, double within) {
  return std::abs(one - other) <= within;
}

// The hand closes along y, across the block's 30 mm.
bool closing_fingers_grip_and_lift() {
  WorldBench bench;
  bench.put_parts({part_at(SceneKind::block, {0.40, 0}, 0)});
  bench.jump(0.40, 0, 0.003, 0.07);
  if (!is_near(bench.world.state().grip_width, 0.03, 1e-6) || bench.world.state().held != 0) return false;
  bench.move(0.40, 0, 0.003, 0.02);
  if (bench.world.state().held != 1 || !is_near(bench.opening_now, 0.03, 4e-4)) return false;
  bench.move(0.45, 0.05, 0.103, 0.02, 0.5);
  const SceneBody& part = bench.part(0);
  return is_near(part.position[2], 0.1, 1e-6) && bench.is_at(0, 0.45, 0.05, 1e-4) &&
         is_near(part.angle, 0.5, 1e-3) && bench.world.counts().contacts == 0 &&
         bench.world.counts().parts_on_table == 0;
}

bool opened_fingers_let_it_fall_as_it_is() {
  WorldBench bench;
  bench.put_parts({part_at(SceneKind::block, {0.40, 0}, 0), part_at(SceneKind::block, {0.50, 0}, 0)});
  bench.jump(0.40, 0, 0.003, 0.07);
  bench.move(0.40, 0, 0.003, 0.02);
  bench.move(0.40, 0, 0.1, 0.02);
  bench.move(0.49, 0.005, 0.1, 0.02, 0.3);
  bench.move(0.49, 0.005, 0.1, 0.07, 0.3);
  // On the other one, which is 25 mm high.
  const SceneBody& part = bench.part(0);
  if (bench.world.state().held != 0 || !is_near(part.position[2], 0.025, 1e-9) ||
      !bench.is_at(0, 0.49, 0.005, 1e-4) || !is_near(part.angle, 0.3, 1e-3) || !bench.is_at(1, 0.50, 0))
    return false;
  // Nothing is below it any more.
  bench.move(0.49, 0.005, 0.3, 0.07, 0.3);
  bench.world.push_part(2, {}, 0.08, 0);
  return bench.part(0).position[2] == 0 && is_apart(bench.world.state());
}

bool an_askew_block_is_turned_until_it_lies_flush() {
  WorldBench bench;
  bench.put_parts({part_at(SceneKind::block, {0.40, 0.003}, 0.25)});
  bench.jump(0.40, 0, 0.003, 0.08);
  // What they will be stopped by is known before they touch it.
  if (!is_near(bench.world.state().grip_width, 0.03, 2e-4)) return false;
  bench.move(0.40, 0, 0.003, 0.02, 0, 100);
  const SceneBody& part = bench.part(0);
  return bench.world.state().held == 1 && is_near(part.angle, 0, 0.01) &&
         is_near(bench.opening_now, 0.03, 5e-4) && is_near(part.position[1], 0, 1e-4) &&
         bench.world.counts().touches > 0;
}

// By its leg, which is 18 mm wide where the fingers are.
bool width_is_that_of_the_place() {
  WorldBench bench;
  const SceneBody bracket = part_at(SceneKind::bracket, {0.40, 0}, 0);
  bench.put_parts({bracket});
  const Outline outline = outline_of(bracket);
  const double leg = 0.40 + (outline.corners[4].x + outline.corners[5].x) / 2;
  const double end = outline.corners[4].y - 0.004;
  bench.jump(leg, end, 0.003, 0.05, half_turn / 2);
  if (!is_near(bench.world.state().grip_width, bracket_arm, 1e-4)) return false;
  bench.move(leg, end, 0.003, 0.01, half_turn / 2);
  return bench.world.state().held == 1 && is_near(bench.opening_now, bracket_arm, 4e-4);
}

bool what_is_not_between_is_not_held() {
  WorldBench bench;
  bench.put_parts({part_at(SceneKind::block, {0.40, 0.06}, 0), part_at(SceneKind::disc, {0.46, 0}, 0)});
  bench.jump(0.40, 0, 0.003, 0.07);
  if (bench.world.state().grip_width != 0) return false;
  bench.move(0.40, 0, 0.003, 0.0);
  if (bench.world.state().held != 0 || bench.opening_now != 0) return false;
  bench.move(0.40, 0, 0.2, 0.0);
  return bench.is_at(0, 0.40, 0.06) && bench.part(0).position[2] == 0;
}

bool two_beside_each_other_stop_fingers_and_stay() {
  WorldBench bench;
  bench.put_parts(
      {part_at(SceneKind::block, {0.40, 0.016}, 0), part_at(SceneKind::block, {0.40, -0.016}, 0)});
  bench.jump(0.40, 0, 0.003, 0.08);
  bench.move(0.40, 0, 0.003, 0.02);
  if (bench.world.state().held != 0 || !is_near(bench.opening_now, 0.06, 1e-3)) return false;
  bench.move(0.40, 0, 0.2, 0.02);
  return bench.part(0).position[2] == 0 && bench.part(1).position[2] == 0 && is_apart(bench.world.state());
}

bool too_high_above_it_grips_nothing() {
  WorldBench bench;
  bench.put_parts({part_at(SceneKind::disc, {0.40, 0}, 0)});
  bench.jump(0.40, 0, 0.0195, 0.07);
  bench.move(0.40, 0, 0.0195, 0.0);
  return bench.world.state().held == 0 && bench.opening_now == 0;
}

bool a_held_part_pushes_and_touches() {
  WorldBench bench;
  SceneBody post{};
  post.kind = SceneKind::post;
  post.position = {0.40, 0.2, 0};
  post.size = {0.04, 0.04, 0.09};
  bench.put_parts({part_at(SceneKind::block, {0.40, 0}, 0), part_at(SceneKind::disc, {0.49, 0}, 0)}, {post});
  bench.jump(0.40, 0, 0.003, 0.07);
  bench.move(0.40, 0, 0.003, 0.02);
  bench.move(0.44, 0, 0.003, 0.02);
  if (!bench.is_at(1, 0.49, 0)) return false;
  bench.move(0.46, 0, 0.003, 0.02);
  // 25 mm of block and 20 of disc.
  if (!is_near(bench.part(1).position[0], 0.505, 6e-4)) return false;
  if (bench.world.counts().contacts != 0) return false;
  bench.move(0.43, 0, 0.02, 0.02);
  bench.move(0.43, 0.2, 0.02, 0.02);
  return bench.world.counts().contacts > 0 && bench.world.state().held == 1;
}

bool a_binned_part_is_counted_and_replaced() {
  WorldBench bench;
  bench.put_parts({part_at(SceneKind::block, {0.40, 0}, 0), part_at(SceneKind::disc, {0.41, 0.41}, 0)});
  bench.jump(0.40, 0, 0.003, 0.07);
  bench.move(0.40, 0, 0.003, 0.02);
  bench.move(0.40, 0, 0.2, 0.02);
  bench.move(0.33, 0.36, 0.2, 0.02);
  if (bench.world.counts().binned[0] != 0) return false;
  bench.move(0.33, 0.36, 0.2, 0.07);
  const SceneBody& part = bench.part(0);
  // A disc in the blocks' bin is none of its own.
  return bench.world.counts().binned[0] == 1 && bench.world.counts().binned[1] == 0 &&
         bench.world.counts().parts_on_table == 1 && part.position[2] == 0 && part.position[1] < 0.25 &&
         part.kind == SceneKind::block && bench.is_at(1, 0.41, 0.41);
}

bool the_same_acts_make_the_same_world() {
  const auto run = [] {
    WorldBench bench;
    const SceneBody first = bench.part(0);
    bench.jump(first.position[0], first.position[1], 0.004, 0.08, first.angle);
    bench.move(first.position[0], first.position[1], 0.004, 0.02, first.angle);
    bench.move(0.45, -0.1, 0.004, 0.02, 0);
    bench.move(0.45, 0.2, 0.004, 0.08, 1);
    bench.move(0.35, -0.2, 0.004, 0.08, 1);
    return bench.world.state();
  };
  const SceneState one = run();
  const SceneState other = run();
  bool moved = false;
  TabletopWorld fresh;
  fresh.begin(HandModel{}, 1);
  for (std::size_t i = 0; i < most_parts; ++i) {
    if (one.parts[i].position != other.parts[i].position || one.parts[i].angle != other.parts[i].angle)
      return false;
    moved = moved || one.parts[i].position != fresh.state().parts[i].position;
  }
  return moved && is_apart(one, 1e-4);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(judged<closing_fingers_grip_and_lift>),
      cmocka_unit_test(judged<opened_fingers_let_it_fall_as_it_is>),
      cmocka_unit_test(judged<an_askew_block_is_turned_until_it_lies_flush>),
      cmocka_unit_test(judged<width_is_that_of_the_place>),
      cmocka_unit_test(judged<what_is_not_between_is_not_held>),
      cmocka_unit_test(judged<two_beside_each_other_stop_fingers_and_stay>),
      cmocka_unit_test(judged<too_high_above_it_grips_nothing>),
      cmocka_unit_test(judged<a_held_part_pushes_and_touches>),
      cmocka_unit_test(judged<a_binned_part_is_counted_and_replaced>),
      cmocka_unit_test(judged<the_same_acts_make_the_same_world>),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
