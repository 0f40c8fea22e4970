// From the values that a client writes to the changes of a reconfiguration.
#pragma once

#include <string>
#include <vector>

#include "runtime/face/directory.hpp"
#include "runtime/json/json_reader.hpp"
#include "runtime/parameters/reconfigure.hpp"

namespace flexrf::panel {

/// What a client wants changed, and everything that is wrong with it.
struct WantedChanges {
  std::vector<ConfigurationChange> changes;
  std::vector<std::string> causes;  ///< as refusals, one per problem; empty when all is right
  std::vector<ComponentIndex> components;
  Role role = Role::engineer;  ///< the greatest that the parameters ask for
};

/// Of `[{"component", "values": {PATH: value}}, ...]`. Allocates.
WantedChanges read_changes(const Directory& directory, JsonArray changes);

}  // namespace flexrf::panel
