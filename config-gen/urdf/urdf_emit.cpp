#include <array>
#include <charconv>

#include "config-gen/model/words.hpp"
#include "config-gen/urdf/urdf_reader.hpp"

namespace flexrf::config_gen {
namespace {

// The shortest text that reads back as the same number, with a point so that it is a double.
std::string literal(double value) {
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value + 0.0).ptr;
  std::string text(buffer.data(), end);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

template <std::size_t Count>
std::string list(const std::array<double, Count>& values) {
  std::string text = "{";
  for (std::size_t i = 0; i < Count; ++i) text += (i == 0 ? "" : ", ") + literal(values[i]);
  return text + "}";
}

const char* kind(UrdfJoint::Kind kind) {
  switch (kind) {
    case UrdfJoint::Kind::revolute:
      return "flexrf::JointKind::revolute";
    case UrdfJoint::Kind::continuous:
      return "flexrf::JointKind::continuous";
    case UrdfJoint::Kind::prismatic:
      break;
  }
  return "flexrf::JointKind::prismatic";
}

std::string transform(const UrdfTransform& value) {
  return "{.position = " + list(value.position) + ", .rotation = " + list(value.rotation) + "}";
}

}  // namespace

std::string emit_kinematic_chain(const UrdfChain& chain) {
  std::string text = "flexrf::KinematicChain{\n    .name = " + string_literal(chain.name) +
                     ",\n    .joint_count = " + std::to_string(chain.joints.size()) + ",\n    .joints = {{\n";
  for (const UrdfJoint& joint : chain.joints) {
    text += "        {.name = " + string_literal(joint.name) + ",\n         .kind = " + kind(joint.kind) +
            ",\n         .origin = " + transform(joint.origin) + ",\n         .axis = " + list(joint.axis) +
            ",\n         .lower = " + literal(joint.lower) + ", .upper = " + literal(joint.upper) +
            ", .velocity = " + literal(joint.velocity) +
            ",\n         .acceleration = " + literal(joint.acceleration) +
            ", .jerk = " + literal(joint.jerk) + ", .home = " + literal(joint.home) + "},\n";
  }
  return text + "    }},\n    .tool = " + transform(chain.tool) + "}";
}

}  // namespace flexrf::config_gen
