// What the cell keeps of its components' values for those who show and save them.
#include <algorithm>
#include <cstring>

#include "runtime/executive/cell.hpp"
#include "runtime/parameters/value_access.hpp"

namespace flexrf {

void Cell::note_configuration(ComponentIndex index) {
  const ParameterBlock& block = component_type(index).configuration;
  const auto* values = static_cast<const std::byte*>(component(index).parameter_memory().configuration);
  if (block.type == nullptr || values == nullptr) return;
  const std::lock_guard lock(configuration_mutex_);
  configurations_[index].assign(values, values + block.type->size);
  configuration_revision_.fetch_add(1, std::memory_order_acq_rel);
}

std::size_t Cell::copy_configuration(ComponentIndex index, void* to, std::size_t size) const {
  const std::lock_guard lock(configuration_mutex_);
  const std::vector<std::byte>& values = configurations_[index];
  std::memcpy(to, values.data(), std::min(size, values.size()));
  return values.size();
}

void Cell::restore_settings(ComponentIndex index, const ComponentSettings& settings) {
  const ParameterBlock& block = component_type(index).configuration;
  const auto* values = static_cast<const std::byte*>(component(index).parameter_memory().configuration);
  if (block.type != nullptr && values != nullptr) {
    const std::lock_guard lock(configuration_mutex_);
    configuration_settings_[index].values.assign(values, values + block.type->size);
    configuration_settings_[index].marks = settings.configuration_marks;
  }
  parameters_[index].restore(settings.runtime_marks);
}

void Cell::note_configuration_set(ComponentIndex index, const FieldPlace& place) {
  const ParameterBlock& block = component_type(index).configuration;
  const auto* values = static_cast<const std::byte*>(component(index).parameter_memory().configuration);
  const std::size_t size =
      place.field->scalar == Scalar::text ? place.count : place.count * element_size(*place.field);
  const std::lock_guard lock(configuration_mutex_);
  ConfigurationSettings& settings = configuration_settings_[index];
  settings.values.assign(values, values + block.type->size);
  if (settings.marks.size() != block.type->size) settings.marks = SetMarks(block.type->size);
  settings.marks.mark(place.offset, size);
  settings_revision_.fetch_add(1, std::memory_order_acq_rel);
}

void Cell::copy_settings(ComponentIndex index, ComponentSettings& settings) const {
  {
    const std::lock_guard lock(configuration_mutex_);
    settings.configuration = configuration_settings_[index].values;
    settings.configuration_marks = configuration_settings_[index].marks;
  }
  // Nothing was set before the file was read, and what it gives is marked in the full size.
  if (settings.configuration_marks.size() != settings.configuration.size())
    settings.configuration_marks = SetMarks(settings.configuration.size());
  parameters_[index].settings().read(settings.runtime, settings.runtime_marks);
}

}  // namespace flexrf
