// Files that the application carries for the panel: custom widgets, robots and their meshes.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "config-gen/read/assembly.hpp"

namespace flexrf::config_gen {

// Once each; the run then depends on it.
void add_panel_file(Model& model, PanelFile file);

// The URDF of the device, if its row names one.
std::optional<std::filesystem::path> robot_of(const Model& model, Index device);

// robots/DEVICE.urdf, and beside it the meshes that it names by a path relative to itself. One that is
// missing or lies elsewhere is reported.
void add_robot_files(Assembly& assembly, Index device);

// A numeric IPv4 or IPv6 address.
bool is_address(const std::string& text);

}  // namespace flexrf::config_gen
