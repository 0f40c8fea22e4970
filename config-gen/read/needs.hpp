// Reads the key `needs`: conditions of commands and of parameters of the configuration.
#pragma once

#include "config-gen/model/model.hpp"
#include "config-gen/read/library.hpp"
#include "config-gen/read/tree.hpp"

namespace flexrf::config_gen {

// Of all rows under [runtime.*] of this table, once its parameters and its feedback have been read. `before`:
// of a driver, its interface, whose values its commands may need, too.
void read_needs(Library& library, const Node& root, ParameterBlock& runtime, const ParameterBlock& feedback,
                const Interface& before = {});

// The same of all rows under [configuration.*]: what else of the configuration has to be so where a row sets
// one of them, to what is neither false nor 0 nor empty.
void read_needs_of_configuration(Library& library, const Node& root, ParameterBlock& configuration,
                                 const ParameterBlock& before = {});

}  // namespace flexrf::config_gen
