// Each state, and each way out of it, with an ideal arm.
#include <cstring>

#include "motion/pose_conversion.hpp"
#include "units/part_picker/tests/picker_world.hpp"
#include "units/vision/camera_view.hpp"
#include "units/vision/hidden_part.hpp"
#include "units/vision/watched_place.hpp"

namespace flexrf::picker_machine_test {
namespace {

using namespace flexrf;
using namespace flexrf::user;
using enum PickerState;

bool a_cycle_is_gone_through_in_order() {
  PickerWorld world;
  world.add(1, 0.5, 0.05);
  world.add(0, 0.42, -0.15, 0.4);
  if (!world.until(waiting, 40)) return false;
  const std::vector<PickerState> expected = {
      retreating,       surveying,        approaching, looking,     descending, closing,    lifting, carrying,
      looking_into_bin, lowering,         releasing,   approaching, looking,    descending, closing, lifting,
      carrying,         looking_into_bin, lowering,    releasing,   surveying,  waiting};
  const auto& counted = world.machine.counters();
  return world.states == expected && world.parts_binned() == 2 && counted.binned == 2 &&
         counted.approaches == 2 && counted.cycle_time > 1 && counted.cycle_time < 15 &&
         world.machine.is_at_rest() && !world.machine.holds_part() && world.machine.track() == 0;
}

bool each_kind_comes_into_its_bin() {
  PickerWorld world;
  world.lay_table();
  if (!world.until(waiting, 60) || world.parts_binned() != 4) return false;
  // One that is laid there later is picked without being told.
  world.add(2, 0.45, -0.02, 1.1);
  return world.until_binned(5) && world.until(waiting) && world.parts_binned() == 5;
}

bool a_part_that_vanishes_is_lost() {
  for (const PickerState state : {approaching, looking, descending}) {
    PickerWorld world;
    PickerWorld::Part& part = world.add(0, 0.42, -0.15, 0.4);
    if (!world.until(state)) return false;
    part.is_there = false;
    if (!world.until(target_lost, 0.5) || world.machine.counters().lost_targets != 1) return false;
    if (*world.machine.cause() == '\0' || world.visits(closing)) return false;
    if (!world.until(waiting, 20) || world.visits(closing)) return false;
    part.is_there = true;
    if (!world.goes_on(1) || world.machine.counters().approaches != 2) return false;
  }
  return true;
}

/// From near by the camera no longer sees it.
bool on_the_last_way_down_it_need_not_be_seen() {
  PickerWorld world;
  PickerWorld::Part& part = world.add(0, 0.42, -0.15, 0.4);
  if (!world.until(descending)) return false;
  while (world.machine.state() == descending && world.tip.z() > 0.05) world.step();
  part.track.found = VisualClass::nothing;
  if (!world.until(closing, 2)) return false;
  part.track.found = VisualClass::target;
  return world.goes_on(1);
}

bool what_is_not_measured_from_near_by_is_left_alone() {
  PickerWorld world;
  PickerWorld::Part& part = world.add(0, 0.42, -0.15, 0.4);
  if (!world.until(looking)) return false;
  part.is_seen = false;
  const Time begun = world.now;
  if (!world.until(target_lost, 3) || world.now - begun < world.wishes.patience) return false;
  if (world.machine.counters().lost_targets != 1) return false;
  part.is_seen = true;
  const Time lost = world.now;
  if (!world.until(waiting, 10) || !world.until(approaching, 40)) return false;
  const double after = seconds(world.now - lost);
  return after > 29 && after < 32 && world.goes_on(1);
}

/// What follows from pushing it: it is gone to anew, or followed where that is no long way.
bool a_part_that_is_pushed_is_not_dragged_after() {
  for (const PickerState state : {approaching, looking, descending}) {
    for (const double way : {0.004, 0.025, 0.09}) {
      for (const double late : {0.0, 0.25}) {
        PickerWorld world;
        PickerWorld::Part& part = world.add(0, 0.42, -0.10, 0.4);
        if (!world.until(state)) return false;
        world.run(late);
        if (world.machine.state() == closing) continue;
        part.track.position[1] += way;
        if (!world.goes_on(1)) return false;
      }
    }
  }
  return true;
}

bool an_obstacle_in_the_way_is_waited_for() {
  for (const PickerState state : {approaching, looking, descending}) {
    PickerWorld world;
    const PickerWorld::Part& part = world.add(0, 0.42, -0.10, 0.4);
    if (!world.until(state)) return false;
    PickerWorld::Part& post = world.add_obstacle(0.42, -0.055);
    if (!world.until(blocked, 0.5) || world.machine.counters().given_up != 1) return false;
    if (std::strstr(world.machine.cause(), "obstacle") == nullptr) return false;
    // Up, and to the look-out; there it stays blocked.
    if (!world.run(12) || world.machine.state() != blocked || !world.machine.is_at_rest()) return false;
    if ((world.tip - world.plan.look_out).norm() > 0.01 || world.visits(closing) || part.is_binned)
      return false;
    post.is_there = false;
    if (!world.goes_on(1)) return false;
  }
  return true;
}

/// And its reason is the present one.
bool other_parts_in_the_way_are_told() {
  PickerWorld world;
  world.add(1, 0.45, 0);
  std::vector<PickerWorld::Part*> around;
  for (int i = 0; i < 6; ++i)
    around.push_back(
        &world.add(0, 0.45 + 0.044 * std::cos(i * 1.047), 0.044 * std::sin(i * 1.047), i * 1.047));
  for (PickerWorld::Part* const one : around) one->track.may_be_target = false;
  if (!world.until(blocked) || std::strstr(world.machine.cause(), "part") == nullptr) return false;
  for (PickerWorld::Part* const one : around) one->is_there = false;
  PickerWorld::Part& post = world.add_obstacle(0.45, 0.044);
  if (!world.run(0.2) || world.machine.state() != blocked) return false;
  if (std::strstr(world.machine.cause(), "obstacle") == nullptr) return false;
  post.is_there = false;
  return world.goes_on(1);
}

/// With a post so near one part is taken last: others may be taken with more room.
bool what_is_just_free_is_taken_last() {
  PickerWorld world;
  const PickerWorld::Part& narrow = world.add(1, 0.45, 0);
  world.add_obstacle(0.45, 0.05);
  const PickerWorld::Part& free = world.add(1, 0.45, -0.18);
  if (!world.until_binned(1) || !free.is_binned || narrow.is_binned) return false;
  return world.until_binned(2) && narrow.is_binned;
}

bool an_obstacle_in_the_bin_is_waited_for() {
  for (const PickerState state : {lifting, carrying}) {
    PickerWorld world;
    world.add(0, 0.42, -0.10, 0.4);
    if (!world.until(state)) return false;
    PickerWorld::Part& post = world.add_obstacle(0.36, 0.38);
    if (!world.until(blocked, 3) || std::strstr(world.machine.cause(), "bin") == nullptr) return false;
    // Beside the bin, from where the camera sees when it is gone.
    if (!world.run(90) || world.machine.state() != blocked || !world.machine.holds_part()) return false;
    if (world.tip.z() < 0.14 || (world.tip.head<2>() - Eigen::Vector2d(0.36, 0.38)).norm() > 0.1)
      return false;
    post.is_there = false;
    if (!world.goes_on(1) || world.machine.counters().approaches != 1) return false;
  }
  return true;
}

/// The hand does not go down if the camera cannot tell what stands in the bin, or beside the part.
bool what_the_camera_cannot_tell_is_not_gone_into() {
  PickerWorld world;
  const PickerWorld::Part& part = world.add(0, 0.42, -0.10, 0.4);
  if (!world.until(carrying)) return false;
  world.can_tell = false;
  if (!world.until(blocked, 6) || std::strstr(world.machine.cause(), "cannot tell") == nullptr) return false;
  if (!world.run(20) || world.machine.state() != blocked || world.visits(lowering)) return false;
  world.can_tell = true;
  if (!world.goes_on(1) || !part.is_binned) return false;
  PickerWorld::Part& next = world.add(0, 0.42, -0.10, 0.4);
  world.can_tell = false;
  if (!world.until(looking) || !world.until(blocked, 3)) return false;
  if (std::strstr(world.machine.cause(), "cannot tell") == nullptr) return false;
  // Left alone for a while, and then looked at again.
  world.can_tell = true;
  world.run(31);
  return world.goes_on(2) && next.is_binned;
}

/// The default of `camera` in the tables of the vision units.
CameraModel camera_beside_the_hand() {
  CameraModel camera{};
  camera.focal_length = 600;
  camera.principal_point = {320, 240};
  camera.width = 640;
  camera.height = 480;
  camera.mount.position = {0.05, 0, 0.05};
  camera.mount.orientation = {0, 0, 0.7071067811865476, 0.7071067811865476};
  camera.blind = {0, 450, 640, 30};
  return camera;
}

/// However a part is held, the camera sees past it all of the place that hand and part will take up.
bool the_place_in_the_bin_is_seen_past_the_part() {
  const CameraModel camera = camera_beside_the_hand();
  for (std::uint16_t kind = 0; kind < part_kinds; ++kind) {
    for (int i = 0; i < 12; ++i) {
      PickerWorld world;
      world.add(kind, 0.45, i % 2 == 0 ? 0.12 : -0.12, 0.5236 * i);
      if (!world.until(looking_into_bin) || !world.machine.watch_for()) return false;
      const PickerWatch& watch = *world.machine.watch_for();
      TargetInHand hand{};
      hand.watch_map() = watch.middle;
      hand.watch_angle = watch.angle;
      hand.watch_from_map() = watch.room.min();
      hand.watch_to_map() = watch.room.max();
      hand.held_from_map() = world.machine.held_box().min();
      hand.held_to_map() = world.machine.held_box().max();
      const PixelRectangle blind = hidden_part(camera, &hand);
      const CameraView view(camera, to_pose(tool_above(world.tip, world.angle, world.plan.hand.reach)));
      const WatchedPlace place(hand);
      for (const auto corner : {Eigen::AlignedBox2d::BottomLeft, Eigen::AlignedBox2d::BottomRight,
                                Eigen::AlignedBox2d::TopLeft, Eigen::AlignedBox2d::TopRight}) {
        Eigen::Vector2d pixel(-1, -1);
        view.to_picture(place.on_table(place.room().corner(corner)), pixel);
        const bool is_seen = pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() < camera.width &&
                             pixel.y() < camera.height &&
                             !blind.holds(static_cast<int>(pixel.x()), static_cast<int>(pixel.y()));
        world.expect(is_seen, "a corner of the place is hidden");
        if (!is_seen) return false;
      }
    }
  }
  return true;
}

/// The hand looks from farther away, and goes on by itself.
bool a_part_that_hides_the_bin_is_looked_past() {
  PickerWorld world;
  world.add(0, 0.42, -0.10, 0.4);
  world.sees_from = 0.11;
  return world.goes_on(1) && world.visits(blocked) && world.machine.counters().approaches == 1;
}

/// An obstacle that came just now is not confirmed yet, and is reason enough.
bool an_obstacle_that_just_came_is_enough() {
  PickerWorld world;
  world.add(0, 0.42, -0.10, 0.4);
  if (!world.until(looking_into_bin)) return false;
  PickerWorld::Part& post = world.add_obstacle(0.36, 0.38);
  post.track.confirmed = false;
  if (!world.until(blocked, 1) || world.visits(lowering)) return false;
  post.is_there = false;
  return world.goes_on(1);
}

bool what_is_beyond_reach_is_told() {
  PickerWorld world;
  world.add(0, 1.3, 0);
  world.add(1, 0.15, 0.1);
  if (!world.until(unreachable) || !world.run(5)) return false;
  if (world.machine.state() != unreachable || world.machine.counters().approaches != 0) return false;
  if (!world.machine.is_at_rest() || std::strstr(world.machine.cause(), "reach") == nullptr) return false;
  world.add(2, 0.5, 0);
  return world.until_binned(1);
}

bool an_arm_that_does_not_get_there_gives_up() {
  for (const PickerState state : {surveying, approaching, descending, lifting, carrying, lowering}) {
    PickerWorld world;
    world.lay_table();
    if (!world.until(state)) return false;
    world.is_stuck = true;
    const bool had_part = world.machine.holds_part();
    const std::uint64_t begun = world.machine.counters().approaches;
    if (!world.until(unreachable, 2) || *world.machine.cause() == '\0') return false;
    if (!world.run(10) || world.machine.holds_part() != had_part) return false;
    if (had_part && world.machine.counters().approaches != begun) return false;
    world.is_stuck = false;
    world.run(31);  // what was tried meanwhile is left alone for so long
    if (!world.goes_on(4)) return false;
  }
  return true;
}

/// A stuck arm is no part's trouble: no part is left alone for it.
bool a_stuck_arm_gives_up_no_part() {
  PickerWorld world;
  world.lay_table();
  if (!world.until(approaching)) return false;
  world.is_stuck = true;
  if (!world.run(20) || world.machine.counters().approaches != 1) return false;
  if (std::strstr(world.machine.cause(), "does not move") == nullptr && !world.until(unreachable, 3))
    return false;
  world.is_stuck = false;
  const Time freed = world.now;
  if (!world.goes_on(4) || world.machine.counters().given_up != 1) return false;
  return world.now - freed < std::chrono::seconds(80);
}

/// A part that is held is brought away, and nothing else is begun.
bool at_the_end_a_part_in_hand_is_brought_away() {
  for (const PickerState state : {surveying, approaching, lifting, carrying, lowering}) {
    PickerWorld world;
    world.lay_table();
    if (!world.until(state)) return false;
    const std::size_t begun = world.machine.holds_part() ? 1 : 0;
    world.finishing = true;
    if (!world.until(paused, 10) || !world.run(20) || world.parts_binned() != begun) return false;
    if (world.machine.state() != paused || std::strstr(world.machine.cause(), "ends") == nullptr)
      return false;
  }
  return true;
}

bool a_way_that_takes_too_long_is_given_up() {
  PickerWorld world;
  PickerWorld::Part& part = world.add(0, 0.42, -0.10, 0.4);
  world.wishes.leg_timeout = std::chrono::seconds(2);
  if (!world.until(approaching)) return false;
  world.arm_speed = 0.001;
  if (!world.until(unreachable, 2.1) || world.machine.counters().given_up != 1) return false;
  world.arm_speed = 0.6;
  // Left alone for a while.
  if (!world.run(20) || part.is_binned || world.machine.state() != waiting) return false;
  world.run(15);
  return world.goes_on(1);
}

/// However seldom a picture comes, and however many are asked for.
bool a_slow_camera_is_waited_for() {
  PickerWorld world;
  world.steps_per_picture = 40;  // 280 ms
  world.wishes.patience = std::chrono::seconds(5);
  world.wishes.leg_timeout = std::chrono::seconds(3);
  world.lay_table();
  return world.goes_on(4) && !world.visits(unreachable) && world.machine.counters().approaches == 4;
}

bool fingers_that_close_on_nothing_twice_leave_it_alone() {
  PickerWorld world;
  PickerWorld::Part& part = world.add(0, 0.42, -0.10, 0.4);
  for (std::uint64_t i = 1; i <= 2; ++i) {
    if (!world.until(closing)) return false;
    part.is_there = false;
    if (!world.until(grasp_failed, 2) || world.machine.counters().failed_grasps != i) return false;
    part.is_there = true;
    if (!world.run(0.6)) return false;
  }
  const Time left = world.now;
  if (!world.until(waiting, 10) || !world.until(closing, 60) || !world.is_well) return false;
  return world.now - left > std::chrono::seconds(27) && world.goes_on(1) &&
         world.machine.counters().approaches == 3;
}

bool a_part_that_falls_is_lost_and_told() {
  for (const PickerState state : {lifting, carrying, lowering}) {
    PickerWorld world;
    world.lay_table();
    if (!world.until(state)) return false;
    world.arm_speed = 0.2;  // fingers have time to find out
    world.take_from_hand();
    if (!world.until(part_lost, 2) || world.machine.counters().lost_parts != 1) return false;
    if (world.machine.holds_part() || world.machine.track() != 0) return false;
    if (!world.goes_on(3) || world.machine.counters().lost_parts != 1) return false;
  }
  return true;
}

KeepOut box(double x, double y, double to_x, double to_y, double high) {
  KeepOut made{};
  made.from = {x, y, 0};
  made.to = {to_x, to_y, high};
  return made;
}

/// The hand and the camera beside it come into none of them.
bool keep_outs_are_gone_around() {
  const KeepOut wall[] = {box(0.40, 0.15, 0.62, 0.17, 0.5)};
  PickerPlan plan = usual_plan();
  plan.keep_outs = wall;
  PickerWorld world(plan);
  world.lay_table();
  world.parts[1].track.position = {0.50, 0.02};
  world.parts[2].track.position = {0.30, -0.02};
  world.tip = {0.35, -0.1, 0.25};
  for (double t = 0; t < 90 && world.machine.state() != waiting; t += 0.007) {
    world.step();
    const Eigen::Vector2d tip = world.tip.head<2>();
    const Eigen::Vector2d apart =
        tip - tip.cwiseMax(Eigen::Vector2d(0.40, 0.15)).cwiseMin(Eigen::Vector2d(0.62, 0.17));
    world.expect(apart.norm() > 0.065, "into a box");
  }
  return world.is_well && world.parts_binned() == 4;
}

/// A part is no reason to go into one, however low it is.
bool parts_in_keep_outs_are_left() {
  for (const double high : {0.05, 0.5}) {
    const KeepOut fixture[] = {box(0.35, -0.20, 0.45, -0.10, high)};
    PickerPlan plan = usual_plan();
    plan.keep_outs = fixture;
    PickerWorld world(plan);
    const PickerWorld::Part& part = world.add(0, 0.40, -0.15);
    if (!world.until(unreachable) || !world.run(10) || part.is_binned) return false;
    if (world.machine.counters().approaches != 0 || *world.machine.cause() == '\0') return false;
    world.add(2, 0.5, 0.1);
    if (!world.until_binned(1) || part.is_binned) return false;
  }
  return true;
}

/// Around the bin of blocks; the others are picked, and blocks when it is gone.
bool a_bin_behind_a_fence_is_told() {
  const KeepOut fence[] = {box(0.2, 0.24, 0.48, 0.25, 0.5), box(0.47, 0.24, 0.48, 0.6, 0.5),
                           box(0.2, 0.24, 0.21, 0.6, 0.5), box(0.2, 0.59, 0.48, 0.6, 0.5)};
  PickerPlan plan = usual_plan();
  plan.keep_outs = fence;
  PickerWorld world(plan);
  world.add(0, 0.42, -0.10, 0.4);
  if (!world.until(blocked) || *world.machine.cause() == '\0' || !world.run(5)) return false;
  return world.machine.state() == blocked && world.machine.holds_part() && world.machine.is_at_rest();
}

/// Laid down gently: fingers that are made ready for the next part do not take it up again.
bool fingers_close_no_more_around_what_was_released() {
  PickerPlan plan = usual_plan();
  plan.drop_height = 0.01;
  PickerWorld world(plan);
  world.add(1, 0.45, 0);          // of 40 mm
  world.add(3, 0.55, 0.05, 1.2);  // of 18 mm
  if (!world.until(releasing)) return false;
  world.arm_speed = 0.05;  // slower than the fingers
  return world.goes_on(2);
}

template <bool (*Run)()>
void passes(void**) {
  assert_true(Run());
}

}  // namespace
}  // namespace flexrf::picker_machine_test

int main() {
  using namespace flexrf::picker_machine_test;
  const CMUnitTest tests[] = {
      {"a cycle in order", passes<a_cycle_is_gone_through_in_order>, nullptr, nullptr, nullptr},
      {"each kind into its bin", passes<each_kind_comes_into_its_bin>, nullptr, nullptr, nullptr},
      {"a part vanishes", passes<a_part_that_vanishes_is_lost>, nullptr, nullptr, nullptr},
      {"the last way down", passes<on_the_last_way_down_it_need_not_be_seen>, nullptr, nullptr, nullptr},
      {"not measured from near by", passes<what_is_not_measured_from_near_by_is_left_alone>, nullptr, nullptr,
       nullptr},
      {"a part is pushed", passes<a_part_that_is_pushed_is_not_dragged_after>, nullptr, nullptr, nullptr},
      {"an obstacle in the way", passes<an_obstacle_in_the_way_is_waited_for>, nullptr, nullptr, nullptr},
      {"other parts in the way", passes<other_parts_in_the_way_are_told>, nullptr, nullptr, nullptr},
      {"what is just free", passes<what_is_just_free_is_taken_last>, nullptr, nullptr, nullptr},
      {"an obstacle in the bin", passes<an_obstacle_in_the_bin_is_waited_for>, nullptr, nullptr, nullptr},
      {"what cannot be told", passes<what_the_camera_cannot_tell_is_not_gone_into>, nullptr, nullptr,
       nullptr},
      {"seen past the part", passes<the_place_in_the_bin_is_seen_past_the_part>, nullptr, nullptr, nullptr},
      {"looked past", passes<a_part_that_hides_the_bin_is_looked_past>, nullptr, nullptr, nullptr},
      {"an obstacle that just came", passes<an_obstacle_that_just_came_is_enough>, nullptr, nullptr, nullptr},
      {"beyond reach", passes<what_is_beyond_reach_is_told>, nullptr, nullptr, nullptr},
      {"the arm is stuck", passes<an_arm_that_does_not_get_there_gives_up>, nullptr, nullptr, nullptr},
      {"a stuck arm gives up no part", passes<a_stuck_arm_gives_up_no_part>, nullptr, nullptr, nullptr},
      {"at the end", passes<at_the_end_a_part_in_hand_is_brought_away>, nullptr, nullptr, nullptr},
      {"the way takes too long", passes<a_way_that_takes_too_long_is_given_up>, nullptr, nullptr, nullptr},
      {"a slow camera", passes<a_slow_camera_is_waited_for>, nullptr, nullptr, nullptr},
      {"a grasp fails twice", passes<fingers_that_close_on_nothing_twice_leave_it_alone>, nullptr, nullptr,
       nullptr},
      {"a part falls", passes<a_part_that_falls_is_lost_and_told>, nullptr, nullptr, nullptr},
      {"around keep-outs", passes<keep_outs_are_gone_around>, nullptr, nullptr, nullptr},
      {"parts in keep-outs", passes<parts_in_keep_outs_are_left>, nullptr, nullptr, nullptr},
      {"a fenced bin", passes<a_bin_behind_a_fence_is_told>, nullptr, nullptr, nullptr},
      {"gently laid down", passes<fingers_close_no_more_around_what_was_released>, nullptr, nullptr, nullptr},
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
