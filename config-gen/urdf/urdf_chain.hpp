#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace flexrf::config_gen {

// The most joints a chain may have: that of the runtime's KinematicChain.
inline constexpr std::size_t urdf_max_joints = 8;
// Of any number in the file, in m, rad and their derivatives: with more, poses would not be finite, or
// without meaning.
inline constexpr double urdf_greatest_number = 1e6;

// Position in m and rotation column by column: p_parent = rotation * p + position.
struct UrdfTransform {
  std::array<double, 3> position{};
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};
};

struct UrdfJoint {
  std::string name;
  UrdfTransform origin;                 // in the frame of the movable joint before; fixed joints are merged
  std::array<double, 3> axis{1, 0, 0};  // normalised
  double lower = 0;                     // rad
  double upper = 0;                     // rad
  double velocity = 0;                  // rad/s
  double acceleration = 0;              // rad/s^2, from <flexrf>
  double jerk = 0;                      // rad/s^3, from <flexrf>
  double home = 0;                      // rad, from <flexrf>
};

// The serial chain of revolute joints from a URDF's root link to its only tip.
struct UrdfChain {
  std::string name;
  std::vector<UrdfJoint> joints;
  UrdfTransform tool;
};

struct UrdfError {
  std::string file;
  std::size_t line = 0;    // from 1; 0 where the file as a whole is meant
  std::size_t column = 0;  // from 1
  std::string message;
  std::string hint;  // may be empty

  // "file:line:column: error: message" and, on a line of its own, the hint.
  std::string text() const;
};

struct UrdfResult {
  std::optional<UrdfChain> chain;  // empty when there are errors
  std::vector<UrdfError> errors;   // in the order of the file
};

// Reads links, joints, <limit>, <axis>, <origin>, and <flexrf acceleration jerk home> in each movable joint.
// What a controller does not need (visual, collision, inertial) is passed over.
UrdfResult read_urdf(const std::filesystem::path& file);
UrdfResult parse_urdf(std::string_view text, const std::string& file_name);

// A C++ expression of type flexrf::KinematicChain, for
//   inline constexpr flexrf::KinematicChain NAME = <expression>;
// in a file that includes kinematic_chain_header. The same chain gives the same text.
std::string emit_kinematic_chain(const UrdfChain& chain);
inline constexpr std::string_view kinematic_chain_header = "hal/interfaces/robot_arm/kinematic_chain.hpp";

}  // namespace flexrf::config_gen
