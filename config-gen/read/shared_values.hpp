// configuration.P = { as = "unit.M" }: a value that stands once in a table, and that several rows need.
#pragma once

#include "config-gen/model/diagnostics.hpp"
#include "config-gen/read/tree.hpp"

namespace flexrf::config_gen {

// In the rows of units and devices of a table, puts the value that is meant in the place of each reference.
// What is meant has no value, or leads back to the reference: reported, and the value is as if it were not
// written.
void share_values(Node& table, Diagnostics& diagnostics);

}  // namespace flexrf::config_gen
