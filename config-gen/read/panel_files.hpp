// Files that the application carries for the panel: custom widgets, robots and their meshes.
#pragma once

#include <string>
#include <string_view>

#include "config-gen/read/assembly.hpp"

namespace flexrf::config_gen {

// Once each; the run then depends on it.
void add_panel_file(Model& model, PanelFile file);

// The URDF of the device, if its row names one; else nullptr.
const DeviceResource* robot_of(const Model& model, Index device);

// robots/DEVICE.urdf, the meshes that it names by a path relative to itself, and robots/packages/NAME/PATH
// for those that it names as package://NAME/PATH. For meshes that are not found there is a warning.
void add_robot_files(Assembly& assembly, Index device);

// A numeric IPv4 or IPv6 address.
bool is_address(const std::string& text);

}  // namespace flexrf::config_gen
