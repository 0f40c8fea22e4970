#include "web-ui/server/api/configuration_values.hpp"

namespace flexrf::panel {

ConfigurationValues::ConfigurationValues(Cell& cell, const Directory& directory)
    : cell_(&cell), directory_(&directory), values_(cell.component_count()) {
  refresh();
}

void ConfigurationValues::refresh() {
  const std::lock_guard lock(mutex_);
  for (ComponentIndex i = 0; i < cell_->component_count(); ++i) {
    const TypeDescriptor* const type = directory_->entry(i).type->configuration.type;
    const auto* const memory =
        static_cast<const std::byte*>(cell_->component(i).parameter_memory().configuration);
    if (type != nullptr && memory != nullptr) values_[i].assign(memory, memory + type->size);
  }
}

void ConfigurationValues::copy(ComponentIndex component, std::vector<std::byte>& values) const {
  const std::lock_guard lock(mutex_);
  values.assign(values_[component].begin(), values_[component].end());
}

}  // namespace flexrf::panel
