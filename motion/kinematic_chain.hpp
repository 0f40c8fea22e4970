#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace flexrf {

// The most joints a serial arm may have: a six-axis arm has two to spare. Joint vectors have this length
// throughout, and entries from `joint_count` on are zero, so that nothing about an arm is sized at run time.
inline constexpr std::size_t max_joints = 8;

// A frame seen from its parent: p_parent = rotation * p + position.
struct ChainTransform {
  std::array<double, 3> position{};                           // m
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};  // column by column, as Eigen stores it
};

// URDF's names.
enum class JointKind : std::uint8_t {
  revolute,    // turns between its ends: positions in rad
  continuous,  // turns without end: in rad; lower and upper are farther than any motion
  prismatic,   // slides along its axis: in m
};

// Wherever a joint's position or rate stands, its unit of measure is that of the joint: rad, or m where it
// slides.
struct ChainJoint {
  std::string_view name;
  JointKind kind = JointKind::revolute;
  ChainTransform origin;                // this joint's frame at position 0, in the frame of the joint before
  std::array<double, 3> axis{0, 0, 1};  // unit vector in this joint's frame
  double lower = 0;                     // rad or m
  double upper = 0;                     // rad or m, above `lower`
  double velocity = 0;                  // per s, largest magnitude
  double acceleration = 0;              // per s^2, largest magnitude
  double jerk = 0;                      // per s^3, largest magnitude
  double home = 0;                      // rad or m, the posture the arm rests in; away from singularities
};

// A serial chain of joints from the arm's base to its tool: plain data that config-gen writes as a constant
// from a URDF.
struct KinematicChain {
  std::string_view name;
  std::size_t joint_count = 0;  // at most max_joints
  std::array<ChainJoint, max_joints> joints{};
  ChainTransform tool;  // the tool's frame in the frame of the last joint
};

}  // namespace flexrf
