// Reads a URDF, as it is downloaded, into the chain that an application asks for.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "config-gen/model/diagnostics.hpp"
#include "config-gen/model/urdf_chain.hpp"

namespace flexrf::config_gen {

// A link of the file, and where the application names it.
struct UrdfFrame {
  std::string link;
  Position position;
};

// What an application says of one joint. It goes before what the file says.
struct UrdfJointRow {
  Position position;
  std::optional<double> lower;         // rad, or m where it slides; a continuous joint gets ends by both
  std::optional<double> upper;         // rad or m
  std::optional<double> velocity;      // per s
  std::optional<double> acceleration;  // per s^2
  std::optional<double> jerk;          // per s^3
  std::optional<double> home;          // rad or m
};

// What an application says of a robot beside its file.
struct UrdfRow {
  std::string name = "[device.NAME.urdf]";  // how messages call it
  Position position;                        // where the file is named
  std::optional<UrdfFrame> base;            // else the file's root
  std::optional<UrdfFrame> tool;            // else see read_urdf()
  std::map<std::string, UrdfJointRow> joints;
};

// The serial chain of movable joints from base to tool, and the meshes of all links; nothing where there was
// an error. Inertia, collisions, transmissions and simulators' elements are passed over.
//
// Without a row for it, the tool is the only fixed frame at the chain's end; else the one called tool0; else
// the last link that moves, with a warning. The chain ends where a hand begins: at a link that carries
// several movable joints, with fewer in a row than came before. What a joint lacks beside URDF's own limits:
// acceleration and jerk may be in its <flexrf acceleration jerk home>, or in URDF 1.2's <limit acceleration
// deceleration jerk>, of which the smaller acceleration counts; else they are such that it comes to its full
// velocity in 1 s, and to its full acceleration in 0.2 s, with a warning. Its home is 0, or the middle of a
// range without 0. Its range is the narrower one of <limit> and the soft limits of <safety_controller>.
// check_words() tells what becomes of what else stands in a joint.
std::optional<UrdfChain> read_urdf(const std::filesystem::path& file, const UrdfRow& row,
                                   Diagnostics& diagnostics);
std::optional<UrdfChain> parse_urdf(std::string_view text, const std::string& file_name, const UrdfRow& row,
                                    Diagnostics& diagnostics);

// A C++ expression of type flexrf::KinematicChain, for
//   inline constexpr flexrf::KinematicChain NAME = <expression>;
// in a file that includes kinematic_chain_header. The same chain gives the same text.
std::string emit_kinematic_chain(const UrdfChain& chain);
inline constexpr std::string_view kinematic_chain_header = "motion/kinematic_chain.hpp";

}  // namespace flexrf::config_gen
