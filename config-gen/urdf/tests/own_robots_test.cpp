// The robots that come with FlexRF: the arm alone, and with a gripper and a camera.
#include <cmath>
#include <string>

#include "config-gen/urdf/urdf_reader.hpp"
#include "places.hpp"
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf::config_gen;

UrdfRow row_of(const char* tool) {
  UrdfRow row;
  row.position = {intern("cell.toml"), 7, 8};
  if (*tool != '\0') row.tool = UrdfFrame{tool, {intern("cell.toml"), 8, 8}};
  return row;
}

bool is_at(const UrdfTransform& frame, double x, double y, double z) {
  return std::hypot(frame.position[0] - x, frame.position[1] - y, frame.position[2] - z) < 1e-9;
}

// The axis `i` of one frame (0 x, 1 y, 2 z) points where the axis `j` of the other does.
bool same_axis(const UrdfTransform& one, std::size_t i, const UrdfTransform& other, std::size_t j) {
  double difference = 0;
  for (std::size_t row = 0; row < 3; ++row)
    difference += std::abs(one.rotation[3 * i + row] - other.rotation[3 * j + row]);
  return difference < 1e-9;
}

bool same(const UrdfJoint& a, const UrdfJoint& b) {
  return a.name == b.name && a.origin.position == b.origin.position &&
         a.origin.rotation == b.origin.rotation && a.axis == b.axis && a.lower == b.lower &&
         a.upper == b.upper && a.velocity == b.velocity && a.acceleration == b.acceleration &&
         a.jerk == b.jerk && a.home == b.home;
}

// Bodies to collide and masses are in both, and say nothing to the chain.
bool both_are_the_same_arm() {
  Diagnostics diagnostics;
  const auto arm = read_urdf(place::arm_urdf, row_of(""), diagnostics);
  const auto hand = read_urdf(place::gripper_urdf, row_of("gripper_tip"), diagnostics);
  if (!arm || !hand || diagnostics.failed() || arm->joints.size() != 6 || hand->joints.size() != 6)
    return false;
  for (std::size_t i = 0; i < 6; ++i)
    if (!same(arm->joints[i], hand->joints[i])) return false;
  return is_at(arm->tool, 0.10, 0, 0) && is_at(hand->tool, 0.26, 0, 0) &&
         arm->tool.rotation == hand->tool.rotation;
}

// Beside the gripper, looking along the tool's z; its x is the tool's y.
bool the_camera_is_on_the_flange() {
  Diagnostics diagnostics;
  const auto camera = read_urdf(place::gripper_urdf, row_of("camera_optical"), diagnostics);
  const auto tip = read_urdf(place::gripper_urdf, row_of("gripper_tip"), diagnostics);
  return camera && tip && !diagnostics.failed() && camera->joints.size() == 6 &&
         is_at(camera->tool, 0.15, 0, -0.05) && same_axis(camera->tool, 2, tip->tool, 2) &&
         same_axis(camera->tool, 0, tip->tool, 1);
}

void test_both_are_the_same_arm(void**) {
  assert_true(both_are_the_same_arm());
}
void test_the_camera_is_on_the_flange(void**) {
  assert_true(the_camera_is_on_the_flange());
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_both_are_the_same_arm),
      cmocka_unit_test(test_the_camera_is_on_the_flange),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
