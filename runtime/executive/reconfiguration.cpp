#include "runtime/executive/reconfiguration.hpp"

#include <algorithm>

#include "runtime/parameters/value_access.hpp"

namespace flexrf {

Component* Reconfiguration::component(std::uint16_t index) {
  return index < cell_->component_count() ? &cell_->component(index) : nullptr;
}

bool Reconfiguration::is_initialised(std::uint16_t index) const {
  const Life life = cell_->application().component_state(index).life.load();
  // What is waited for is begun anew like what runs, with the values that count then.
  return life == Life::running || life == Life::initialised || life == Life::waiting;
}

std::vector<std::uint16_t> Reconfiguration::owners_of(std::span<const std::uint16_t> changed) {
  const Application& application = cell_->application();
  std::vector<std::uint16_t> owners;
  const auto add = [&](std::uint16_t index) {
    if (is_initialised(index) && std::find(owners.begin(), owners.end(), index) == owners.end())
      owners.push_back(index);
  };
  const auto add_unit_of = [&](const DeviceRecord& device) {
    if (device.unit != no_index) add(device.unit);
  };
  // A bus may carry a bus.
  const auto add_carried = [&](const auto& self, std::uint16_t bus) -> void {
    for (const DeviceRecord& device : application.devices) {
      if (device.bus == no_index || application.devices[device.bus].index != bus) continue;
      add(device.index);
      add_unit_of(device);
      self(self, device.index);
    }
  };
  for (const std::uint16_t index : changed) {
    add(index);
    for (const std::uint16_t device : cell_->devices_of(index)) add_unit_of(application.devices[device]);
    add_carried(add_carried, index);
  }
  const auto rank = [&](std::uint16_t index) {
    const std::uint8_t level = application.component(index).level;
    return level * 2 + (level == level_unit && cell_->moves_something(index) ? 1 : 0);
  };
  std::stable_sort(owners.begin(), owners.end(),
                   [&rank](std::uint16_t a, std::uint16_t b) { return rank(a) > rank(b); });
  return owners;
}

Status Reconfiguration::stop(std::uint16_t owner) {
  const Status status = lifecycle_->stop(owner);
  // What follows seeds its set-points anew; until a person says so, nothing moves.
  cell_->control().require_start();
  return status;
}

Status Reconfiguration::initialise(std::uint16_t owner) {
  const Status status = lifecycle_->start(owner);
  // A device that need not be there takes its values, and is waited for.
  return cell_->application().component_state(owner).life.load() == Life::waiting ? Status{} : status;
}

void Reconfiguration::fault(std::uint16_t owner, const Status& cause) {
  cell_->set_fault(owner, cause);
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
  std::vector<ConfigurationComponent> components(cell.component_count());
  for (ComponentIndex i = 0; i < cell.component_count(); ++i) {
    ConfigurationComponent& component = components[i];
    component.name = cell.component_name(i);
    component.type = &cell.component_type(i);
    component.kind = application.component(i).kind;
    component.driver = cell.driver_name(i);
    component.other_drivers = cell.other_drivers(i);
  }
  return components;
}

ConfigurationIdentity configuration_identity(const Cell& cell) {
  return {cell.application().name, cell.application().descriptor_hash, cell.application().renames};
}

}  // namespace flexrf
