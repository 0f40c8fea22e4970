// What commands need: the key `needs` of buttons and holds.
#pragma once

#include "config-gen/model/model.hpp"
#include "config-gen/read/library.hpp"
#include "config-gen/read/tree.hpp"

namespace flexrf::config_gen {

// Of all rows under [runtime.*] of this table, once its parameters and its feedback have been read. `before`:
// of a driver, its interface, whose values its commands may need, too.
void read_needs(Library& library, const Node& root, ParameterBlock& runtime, const ParameterBlock& feedback,
                const Interface& before = {});

}  // namespace flexrf::config_gen
