// [device_list.N]: rows of [device.N] that stand in a list, as an IO list of electrical engineers.
#pragma once

#include <filesystem>
#include <vector>

#include "config-gen/model/diagnostics.hpp"
#include "config-gen/read/tree.hpp"

namespace flexrf::config_gen {

// Adds the rows of all lists that the table of an application or a group names to its section `device`, as if
// they were written there, and takes the section `device_list` out. Lists are looked for from `folder`, and
// added to `files`. False when something was wrong, which is reported: devices may be missing then.
bool add_listed_devices(Node& table, const std::filesystem::path& folder, Diagnostics& diagnostics,
                        std::vector<std::filesystem::path>& files);

}  // namespace flexrf::config_gen
