#pragma once

#include <filesystem>
#include <optional>

#include "config-gen/model/diagnostics.hpp"
#include "config-gen/model/register_map.hpp"

namespace flexrf::config_gen {

// The register map in this list (docs/tables.md says its columns). Nothing when there were errors, which are
// all reported.
std::optional<RegisterMap> read_register_map(const std::filesystem::path& file, Diagnostics& diagnostics);

}  // namespace flexrf::config_gen
