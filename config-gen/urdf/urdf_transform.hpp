// Arithmetic of frames, and the numbers of a URDF. Private to config-gen/urdf.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "config-gen/model/urdf_chain.hpp"

namespace flexrf::config_gen {

// First b, then a: the frame that is at b in the frame a.
UrdfTransform compose(const UrdfTransform& a, const UrdfTransform& b);
UrdfTransform inverse(const UrdfTransform& transform);
// URDF's fixed-axis roll, pitch, yaw in rad: R = Rz(yaw) Ry(pitch) Rx(roll).
std::array<double, 9> rotation_of(const std::array<double, 3>& rpy);

// False for what is no number, or a greater one than urdf_greatest_number.
bool parse_number(std::string_view text, double& value);
bool parse_triple(const std::string& text, std::array<double, 3>& values);

}  // namespace flexrf::config_gen
