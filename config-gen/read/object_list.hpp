#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "config-gen/model/diagnostics.hpp"
#include "config-gen/model/object_list.hpp"

namespace flexrf::config_gen {

// A parameter of the driver's configuration, which rows may name.
struct ListParameter {
  std::string name;
  std::vector<std::string> values;  // of an enumeration, by their numbers
};

// The list of objects in this file (docs/tables.md says its columns). Rows with errors, which are all
// reported, are left out.
std::vector<NeededObject> read_object_list(const std::filesystem::path& file,
                                           const std::vector<ListParameter>& parameters,
                                           Diagnostics& diagnostics);

}  // namespace flexrf::config_gen
