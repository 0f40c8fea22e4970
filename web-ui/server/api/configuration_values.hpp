// Configuration parameters as the components have them, for a thread that must not look into the components.
#pragma once

#include <cstddef>
#include <mutex>
#include <vector>

#include "runtime/executive/cell.hpp"
#include "runtime/face/directory.hpp"

namespace flexrf::panel {

class ConfigurationValues {
 public:
  /// Takes the values. Before anything runs.
  ConfigurationValues(Cell& cell, const Directory& directory);

  /// Takes them anew, after a reconfiguration. The lifecycle thread.
  void refresh();
  /// Copies one component's values; empty when it has none. Any thread that is not real-time.
  void copy(ComponentIndex component, std::vector<std::byte>& values) const;

 private:
  Cell* cell_;
  const Directory* directory_;
  mutable std::mutex mutex_;
  std::vector<std::vector<std::byte>> values_;
};

}  // namespace flexrf::panel
