#include "units/vision/camera_view.hpp"

#include <cmath>
#include <memory>

#include "tests/cmocka.hpp"
#include "units/vision/tests/drawn_table.hpp"
#include "units/vision/tests/vision_bench.hpp"

namespace flexrf::camera_view_test {
namespace {

using namespace flexrf;
using namespace flexrf::user;

struct World {
  StepContext context{1, Time{std::chrono::seconds(1)}};
  HistoryBench<Pose, 8> history;
  InputBinding binding = history.input();
  Input<Pose> poses;

  World() { poses.connect(&context, binding); }
  static Time at(int ms) { return Time{std::chrono::milliseconds(1000 + ms)}; }
  NullReason ask(int ms, Pose& pose) { return tool_pose_at(poses, at(ms), pose); }
};

bool between_two_poses_it_is_between() {
  const auto world = std::make_unique<World>();
  world->history.publish(tool_above(0.40, 0, 0.45), World::at(0));
  world->history.publish(tool_above(0.44, 0, 0.45, 0.2), World::at(8));
  Pose pose{};
  const bool found = world->ask(2, pose) == NullReason::none;
  const Pose quarter = tool_above(0.41, 0, 0.45, 0.05);
  double off = 0;
  for (std::size_t i = 0; i < 3; ++i) off += std::abs(pose.position[i] - quarter.position[i]);
  double dot = 0;
  for (std::size_t i = 0; i < 4; ++i) dot += pose.orientation[i] * quarter.orientation[i];
  return found && off < 1e-9 && std::abs(std::abs(dot) - 1) < 1e-9;
}

/// At 0.9 m/s a pose of 50 ms before is 45 mm away.
bool outside_of_the_history_it_is_unknown() {
  const auto world = std::make_unique<World>();
  Pose pose{};
  const bool nothing = world->ask(0, pose) == NullReason::nothing_yet;
  world->history.publish(tool_above(0.40, 0, 0.45), World::at(0));
  const bool one = world->ask(0, pose) == NullReason::none && world->ask(1, pose) == NullReason::nothing_yet;
  world->history.publish(tool_above(0.44, 0, 0.45), World::at(8));
  const bool exact = world->ask(8, pose) == NullReason::none && std::abs(pose.position[0] - 0.44) < 1e-9;
  const bool before =
      world->ask(-1, pose) == NullReason::nothing_yet && world->ask(-100, pose) == NullReason::nothing_yet;
  return nothing && one && exact && before && world->ask(17, pose) == NullReason::too_old &&
         world->ask(40, pose) == NullReason::too_old && world->ask(100, pose) == NullReason::too_old;
}

/// The first pictures after a start are none of a slot's that keeps too little.
bool only_what_stays_unknown_is_told() {
  const auto world = std::make_unique<World>();
  Pose pose{};
  const bool without_a_writer = lacks_poses(world->ask(0, pose), world->poses);
  world->history.publish(tool_above(0.40, 0, 0.45), World::at(0));
  const bool at_the_start = !lacks_poses(world->ask(-30, pose), world->poses) &&
                            !lacks_poses(world->ask(5, pose), world->poses) &&
                            !lacks_poses(world->ask(0, pose), world->poses);
  for (int i = 1; i < 20; ++i) world->history.publish(tool_above(0.40, 0, 0.45), World::at(8 * i));
  return without_a_writer && at_the_start && world->ask(0, pose) == NullReason::no_longer_kept &&
         lacks_poses(NullReason::no_longer_kept, world->poses) &&
         lacks_poses(world->ask(300, pose), world->poses);
}

bool within_a_cycle_of_the_newest_the_motion_goes_on() {
  const auto world = std::make_unique<World>();
  world->history.publish(tool_above(0.40, 0, 0.45), World::at(0));
  world->history.publish(tool_above(0.44, 0, 0.45, 0.2), World::at(8));
  Pose pose{};
  const bool found = world->ask(14, pose) == NullReason::none;
  const Pose expected = tool_above(0.47, 0, 0.45, 0.35);
  double dot = 0;
  for (std::size_t i = 0; i < 4; ++i) dot += pose.orientation[i] * expected.orientation[i];
  return found && std::abs(pose.position[0] - 0.47) < 1e-9 && std::abs(std::abs(dot) - 1) < 1e-9;
}

void interpolation(void**) {
  assert_true(between_two_poses_it_is_between());
  assert_true(outside_of_the_history_it_is_unknown());
  assert_true(within_a_cycle_of_the_newest_the_motion_goes_on());
  assert_true(only_what_stays_unknown_is_told());
}

void what_is_projected_comes_back(void**) {
  const CameraView view(camera_of_tests(), tool_above(0.45, 0.1, 0.4, 0.15));
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d point(0.35 + 0.01 * i, 0.2 - 0.012 * i, 0.002 * i);
    Eigen::Vector2d pixel(0, 0);
    Eigen::Vector2d place(0, 0);
    assert_true(view.to_picture(point, pixel));
    assert_true(view.to_plane(pixel.x(), pixel.y(), point.z(), place));
    assert_true((place - point.head<2>()).norm() < 1e-9);
  }
}

void along_the_axis_is_the_principal_point(void**) {
  CameraModel camera = camera_of_tests();
  camera.mount = {};
  const CameraView view(camera, tool_above(0.45, 0.1, 0.4));
  Eigen::Vector2d pixel(0, 0);
  assert_true(view.to_picture({0.45, 0.1, 0}, pixel));
  assert_true((pixel - Eigen::Vector2d(320, 240)).norm() < 1e-9);
  assert_true(std::abs(view.pixels_per_metre({0.45, 0.1, 0}) - 1500) < 1e-9);
  // y of the picture goes down: towards the robot's -y.
  assert_true(view.to_picture({0.46, 0.09, 0}, pixel));
  assert_true((pixel - Eigen::Vector2d(335, 255)).norm() < 1e-9);
}

void what_cannot_be_seen_is_not(void**) {
  const CameraView view(camera_of_tests(), tool_above(0.45, 0.1, 0.4));
  Eigen::Vector2d none(7, 7);
  assert_false(view.to_picture({0.45, 0.1, 0.5}, none));
  assert_false(view.to_plane(320, 240, 0.5, none));
  assert_true(view.pixels_per_metre({0.45, 0.1, 0.5}) == 0);
  const CameraView level(camera_of_tests(), tool_above(0.45, 0.1, 0.4, 1.6));
  assert_false(level.to_plane(320, 0, 0, none) && level.to_plane(320, 479, 0, none));
  const CameraView broken(camera_of_tests(), tool_above(std::nan(""), 0.1, 0.4));
  assert_false(broken.to_plane(320, 240, 0, none) && none.allFinite());
}

void wrong_cameras_are_refused(void**) {
  assert_true(check_camera(camera_of_tests()).is_ok());
  CameraModel camera = camera_of_tests();
  camera.focal_length = 0;
  assert_false(check_camera(camera).is_ok());
  camera = camera_of_tests();
  camera.width = 1280;
  assert_false(check_camera(camera).is_ok());
  camera = camera_of_tests();
  camera.mount.position[1] = std::nan("");
  assert_false(check_camera(camera).is_ok());
}

}  // namespace
}  // namespace flexrf::camera_view_test

int main() {
  using namespace flexrf::camera_view_test;
  const CMUnitTest tests[] = {cmocka_unit_test(interpolation), cmocka_unit_test(what_is_projected_comes_back),
                              cmocka_unit_test(along_the_axis_is_the_principal_point),
                              cmocka_unit_test(what_cannot_be_seen_is_not),
                              cmocka_unit_test(wrong_cameras_are_refused)};
  return cmocka_run_group_tests_name("camera view", tests, nullptr, nullptr);
}
