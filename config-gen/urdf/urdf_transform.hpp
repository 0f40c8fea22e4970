// Arithmetic of frames, and the numbers of a URDF. Private to config-gen/urdf.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "config-gen/model/urdf_chain.hpp"

namespace flexrf::config_gen {

// First b, then a: the frame that is at b in the frame a.
UrdfTransform compose(const UrdfTransform& a, const UrdfTransform& b);
UrdfTransform inverse(const UrdfTransform& transform);
// URDF's fixed-axis roll, pitch, yaw in rad: R = Rz(yaw) Ry(pitch) Rx(roll).
std::array<double, 9> rotation_of(const std::array<double, 3>& rpy);
// x, y, z, w of any length but 0.
std::array<double, 9> rotation_of_quaternion(const std::array<double, 4>& quaternion);

// False for what is no number, or a greater one than urdf_greatest_number.
bool parse_number(std::string_view text, double& value);
// True where the text is as many of them as `values` has room for.
bool parse_numbers(const std::string& text, std::span<double> values);

}  // namespace flexrf::config_gen
