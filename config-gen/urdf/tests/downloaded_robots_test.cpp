// Robots as they are downloaded, in the styles of the public ones (their dimensions are made up), without a
// word of the application beside the file's name.
#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "config-gen/urdf/urdf_reader.hpp"
#include "places.hpp"
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf::config_gen;

struct Expected {
  const char* robot;
  const char* joints;  // each with its kind: r, c or p
  double tool[3];      // m, with all joints at 0, in the base frame
  double z[3];         // the tool's z axis then
  double first_range[2];
  std::size_t meshes;
  const char* warnings;  // beside that of acceleration and jerk; nullptr: none
};

constexpr Expected robots[] = {
    {"ur_style",
     "shoulder_pan_joint:r shoulder_lift_joint:r elbow_joint:r wrist_1_joint:r wrist_2_joint:r "
     "wrist_3_joint:r ",
     {0.82, 0.225, 0.06},
     {0, 1, 0},
     {-6.13, 6.13},  // its soft limits
     7,
     nullptr},
    {"kuka_style",
     "joint_a1:r joint_a2:r joint_a3:r joint_a4:r joint_a5:r joint_a6:r ",
     {0.98, 0, 0.435},
     {1, 0, 0},
     {-2.967, 2.967},
     7,
     nullptr},
    {"abb_style",
     "joint_1:r joint_2:r joint_3:r joint_4:r joint_5:r joint_6:r ",
     {0.374, 0, 0.63},
     {1, 0, 0},
     {-2.8798, 2.8798},
     7,
     nullptr},
    {"fanuc_style",
     "joint_1:r joint_2:r joint_3:r joint_4:r joint_5:r joint_6:r ",
     {0.465, 0, 0.695},
     {1, 0, 0},
     {-2.96706, 2.96706},
     7,
     nullptr},
    {"franka_style",
     "seven_joint1:r seven_joint2:r seven_joint3:r seven_joint4:r seven_joint5:r seven_joint6:r "
     "seven_joint7:r ",
     {0.09, 0, 0.8166},
     {0, 0, -1},
     {-2.7, 2.7},
     10,
     "franka_style.urdf:220:3: warning: the arm ends at link 'seven_hand': the joints beyond it, from "
     "'seven_finger_joint1' and 'seven_finger_joint2' on, are no part of it (<mimic> is not supported: "
     "nothing "
     "follows)\n"
     "franka_style.urdf:220:3: hint: a gripper is a device of its own; where this is what is meant, write "
     "tool = "
     "\"seven_hand\" in [device.arm.urdf]\n"},
    {"denso_style",
     "joint_1:r joint_2:r joint_3:r joint_4:r joint_5:r joint_6:r ",
     {-0.075, 0, 0.687},
     {0, 0, 1},
     {-2.617994, 2.617994},
     7,
     nullptr},
    {"xarm_style",
     "joint1:r joint2:r joint3:r joint4:r joint5:r joint6:r ",
     {0.207, 0, 0.115},
     {0, 0, -1},
     {-6.283185307179586, 6.283185307179586},
     7,
     nullptr},
    {"kinova_style",
     "joint_1:c joint_2:r joint_3:c joint_4:r joint_5:c joint_6:r joint_7:c ",
     {0, -0.022995, 1.124},
     {0, 0, -1},
     {-1e6, 1e6},
     8,
     "kinova_style.urdf:130:3: warning: the arm's tool is link 'bracelet_link' itself, as more than one "
     "frame is "
     "fixed to it: 'end_effector_link', 'camera_link' and 'tool_frame'\n"
     "kinova_style.urdf:130:3: hint: name the one that is meant: write tool = \"LINK\" in "
     "[device.arm.urdf]\n"},
    {"staubli_style",
     "joint_1:r joint_2:r joint_3:r joint_4:r joint_5:r joint_6:r ",
     {0.05, 0, 1.345},
     {0, 0, 1},
     {-3.14159, 3.14159},
     7,
     nullptr},
    {"motoman_style",
     "joint_1_s:r joint_2_l:r joint_3_u:r joint_4_r:r joint_5_b:r joint_6_t:r ",
     {0.89, 0, 1.264},
     {1, 0, 0},
     {-2.9671, 2.9671},
     7,
     nullptr},
};

struct Frame {
  double position[3] = {0, 0, 0};
  double rotation[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
};

void go_on(Frame& frame, const UrdfTransform& next) {
  const Frame from = frame;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t k = 0; k < 3; ++k) frame.position[row] += from.rotation[row][k] * next.position[k];
    for (std::size_t column = 0; column < 3; ++column) {
      frame.rotation[row][column] = 0;
      for (std::size_t k = 0; k < 3; ++k)
        frame.rotation[row][column] += from.rotation[row][k] * next.rotation[3 * column + k];
    }
  }
}

std::string names_of(const UrdfChain& chain) {
  std::string names;
  for (const UrdfJoint& joint : chain.joints)
    names += joint.name + ":" + "rcp"[static_cast<std::size_t>(joint.kind)] + " ";
  return names;
}

bool same(double a, double b) {
  return std::abs(a - b) < 2e-5;  // as exact as the files' quarter turns
}

bool is_at(const UrdfChain& chain, const Expected& expected) {
  Frame tool;
  for (const UrdfJoint& joint : chain.joints) go_on(tool, joint.origin);
  go_on(tool, chain.tool);
  bool right = true;
  for (std::size_t i = 0; i < 3; ++i) {
    right = right && same(tool.position[i], expected.tool[i]) && same(tool.rotation[i][2], expected.z[i]);
  }
  if (!right)
    print_message("%s: the tool is at %f %f %f, its z is %f %f %f\n", expected.robot, tool.position[0],
                  tool.position[1], tool.position[2], tool.rotation[0][2], tool.rotation[1][2],
                  tool.rotation[2][2]);
  return right;
}

// Without that of acceleration and jerk, which all of them have.
bool warns_as_expected(const Expected& expected, const std::string& messages) {
  const std::string defaults = "cell.toml:7:8: warning: nothing says how quickly joints ";
  const std::size_t at = messages.find(defaults);
  const std::size_t end = messages.find('\n', messages.find("cell.toml:7:8: hint: ")) + 1;
  if (at == std::string::npos) return false;
  const std::string others = messages.substr(0, at) + messages.substr(end);
  if (others == (expected.warnings == nullptr ? "" : expected.warnings)) return true;
  print_message("%s says: %s\n", expected.robot, others.c_str());
  return false;
}

bool is_read(const Expected& expected) {
  UrdfRow row;
  row.name = "[device.arm.urdf]";
  row.position = {intern("cell.toml"), 7, 8};
  Diagnostics diagnostics;
  const auto chain = read_urdf(std::string(expected.robot) + ".urdf", row, diagnostics);
  std::ostringstream messages;
  diagnostics.print(messages);
  if (!chain) {
    print_message("%s is refused: %s\n", expected.robot, messages.str().c_str());
    return false;
  }
  const UrdfJoint& first = chain->joints.front();
  const bool right = names_of(*chain) == expected.joints && chain->meshes.size() == expected.meshes &&
                     first.lower == expected.first_range[0] && first.upper == expected.first_range[1] &&
                     first.acceleration == first.velocity && same(first.jerk, 5 * first.velocity);
  if (!right)
    print_message("%s: %s, %zu meshes\n", expected.robot, names_of(*chain).c_str(), chain->meshes.size());
  return is_at(*chain, expected) && warns_as_expected(expected, messages.str()) && right;
}

void robots_are_read_as_they_are_downloaded(void**) {
  std::filesystem::current_path(place::robots_folder);
  std::size_t right = 0;
  for (const Expected& expected : robots) right += is_read(expected) ? 1 : 0;
  assert_int_equal(right, std::size(robots));
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(robots_are_read_as_they_are_downloaded)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
