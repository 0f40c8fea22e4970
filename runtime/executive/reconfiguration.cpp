#include "runtime/executive/reconfiguration.hpp"

#include <algorithm>

#include "runtime/parameters/value_access.hpp"

namespace flexrf {

Component* Reconfiguration::component(std::uint16_t index) {
  return index < cell_->component_count() ? &cell_->component(index) : nullptr;
}

bool Reconfiguration::is_initialised(std::uint16_t index) const {
  const Application& application = cell_->application();
  const Life life = is_unit(index) ? application.unit_states[index].life.load()
                                   : application.device_states[device_of(index)].life.load();
  return life == Life::running || life == Life::initialised;
}

int Reconfiguration::stopping_rank(std::uint16_t index) const noexcept {
  const Application& application = cell_->application();
  if (is_unit(index)) {
    for (std::size_t d = 0; d < application.devices.size(); ++d) {
      if (application.devices[d].unit == index && cell_->driver(static_cast<std::uint16_t>(d)).actuates)
        return 0;
    }
    return 1;
  }
  return application.devices[device_of(index)].bus == no_index ? 3 : 2;
}

std::vector<std::uint16_t> Reconfiguration::owners_of(std::span<const std::uint16_t> changed) {
  const Application& application = cell_->application();
  std::vector<std::uint16_t> owners;
  const auto add = [&](std::uint16_t index) {
    if (is_initialised(index) && std::find(owners.begin(), owners.end(), index) == owners.end())
      owners.push_back(index);
  };
  for (const std::uint16_t index : changed) {
    add(index);
    if (is_unit(index)) continue;
    const std::uint16_t changed_device = device_of(index);
    if (application.devices[changed_device].unit != no_index) add(application.devices[changed_device].unit);
    for (std::size_t d = 0; d < application.devices.size(); ++d) {
      if (application.devices[d].bus != changed_device) continue;
      add(cell_->component_of_device(static_cast<std::uint16_t>(d)));
      if (application.devices[d].unit != no_index) add(application.devices[d].unit);
    }
  }
  std::stable_sort(owners.begin(), owners.end(),
                   [this](std::uint16_t a, std::uint16_t b) { return stopping_rank(a) < stopping_rank(b); });
  return owners;
}

Status Reconfiguration::stop(std::uint16_t owner) {
  const Status status =
      is_unit(owner) ? lifecycle_->stop_unit(owner) : lifecycle_->stop_device(device_of(owner));
  // What follows seeds its set-points anew; until a person says so, nothing moves.
  cell_->control().require_start();
  return status;
}

Status Reconfiguration::initialise(std::uint16_t owner) {
  return is_unit(owner) ? lifecycle_->start_unit(owner) : lifecycle_->start_device(device_of(owner));
}

void Reconfiguration::fault(std::uint16_t owner, const Status& cause) {
  const Application& application = cell_->application();
  if (is_unit(owner)) {
    application.unit_states[owner].fault.publish(cause);
    application.unit_states[owner].life.store(Life::fault, std::memory_order_release);
    cell_->set_writer_state(owner, WriterState::faulted);
  } else {
    const std::uint16_t device = device_of(owner);
    application.device_states[device].fault.publish(cause);
    application.device_states[device].life.store(Life::fault, std::memory_order_release);
    cell_->set_device_writer_state(device, WriterState::faulted);
  }
  cell_->control().note_fault();
}

void note_set(Cell& cell, std::span<const ConfigurationChange> changes) {
  for (const ConfigurationChange& change : changes) {
    const ParameterBlock& block = cell.component_type(change.component).configuration;
    if (const Result<FieldPlace> place = find_field(*block.type, change.parameter); place)
      cell.note_configuration_set(change.component, *place);
  }
}

std::vector<ConfigurationComponent> configuration_components(Cell& cell) {
  const Application& application = cell.application();
  std::vector<ConfigurationComponent> components;
  const auto add = [&](ComponentIndex index, ConfigurationComponent component) {
    component.name = cell.component_name(index);
    component.type = &cell.component_type(index);
    components.push_back(component);
  };
  for (std::size_t i = 0; i < application.units.size(); ++i) {
    ConfigurationComponent unit;
    unit.kind = ConfigurationComponent::Kind::unit;
    add(static_cast<ComponentIndex>(i), unit);
  }
  for (std::size_t i = 0; i < application.devices.size(); ++i) {
    const auto index = static_cast<std::uint16_t>(i);
    ConfigurationComponent device;
    device.kind = ConfigurationComponent::Kind::device;
    device.driver = cell.driver(index).name;
    device.other_drivers = cell.other_drivers(index);
    add(cell.component_of_device(index), device);
  }
  return components;
}

ConfigurationIdentity configuration_identity(const Cell& cell) {
  return {cell.application().name, cell.application().descriptor_hash, cell.application().renames};
}

}  // namespace flexrf
