// An arm as a URDF describes it: the chain of joints from its base to its tool.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "config-gen/model/position.hpp"

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
  enum class Kind { revolute, continuous, prismatic };
  std::string name;
  Kind kind = Kind::revolute;           // a prismatic joint has m where the others have rad
  UrdfTransform origin;                 // in the frame of the movable joint before; fixed joints are merged
  std::array<double, 3> axis{1, 0, 0};  // normalised
  double lower = 0;                     // rad or m; of a continuous joint -urdf_greatest_number
  double upper = 0;                     // rad or m; of a continuous joint urdf_greatest_number
  double velocity = 0;                  // per s
  double acceleration = 0;              // per s^2
  double jerk = 0;                      // per s^3
  double home = 0;                      // rad or m
};

// What a <visual> names, as it is written.
struct UrdfMesh {
  std::string name;
  Position position;
};

struct UrdfChain {
  std::string name;
  std::vector<UrdfJoint> joints;
  UrdfTransform tool;              // in the frame of the last joint
  std::vector<UrdfMesh> meshes;    // each once, of the whole robot
  std::vector<std::string> links;  // of the whole robot
  std::string base;                // the link that poses are told in
};

}  // namespace flexrf::config_gen
