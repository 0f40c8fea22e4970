// Names that become members of generated classes and structs: each once, and none that is there already.
#pragma once

#include <string>
#include <vector>

#include "config-gen/model/diagnostics.hpp"
#include "config-gen/model/model.hpp"
#include "config-gen/read/tree.hpp"

namespace flexrf::config_gen {

enum class Heir { unit, interface };

// The rows of one section, which become members of the class: `kind` is as "an input".
void add_members(const Node& table, std::string_view section, const std::string& kind,
                 std::vector<std::pair<std::string, const Node*>>& members);
void check_members(Heir heir, const std::vector<std::pair<std::string, const Node*>>& members,
                   Diagnostics& diagnostics);

// Fields of one struct, beside the functions that other fields bring (pose_map() beside pose). `before` stand
// in the same struct, and were judged already.
void check_fields(const std::vector<const Field*>& fields, Diagnostics& diagnostics,
                  const std::vector<const Field*>& before = {});

}  // namespace flexrf::config_gen
