// configuration.P = { as = "unit.M" }: a value that stands once in a table, and that several rows need.
#pragma once

#include "config-gen/model/diagnostics.hpp"
#include "config-gen/read/tree.hpp"

namespace flexrf::config_gen {

// Replaces each reference in the rows of units and devices of a table by the value that it names. A reference
// to nothing, or in a circle, is an error and is removed.
void share_values(Node& table, Diagnostics& diagnostics);

}  // namespace flexrf::config_gen
