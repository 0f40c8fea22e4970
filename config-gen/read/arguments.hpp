// "${name}" in the values of a group's table.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "config-gen/model/diagnostics.hpp"
#include "config-gen/read/library.hpp"

namespace flexrf::config_gen {

using Arguments = std::map<std::string, Node>;

// Puts the arguments in place of "${name}" in all values under `node`: a value that is only "${name}" becomes
// the argument's value with its type. `index` is what "${index}" stands for; rows of [group.N] keep theirs
// until they are instantiated themselves.
void fill_in(Node& node, const Arguments& arguments, std::optional<std::size_t> index, bool in_group,
             Diagnostics& diagnostics);

// The arguments of one instance: given by `with` (may be null), else the defaults. `row` is the instance's.
Arguments read_arguments(Library& library, const Node& group, const Node* with, const Node& row);

}  // namespace flexrf::config_gen
