#include "runtime/executive/component_actions.hpp"

#include <algorithm>

namespace flexrf {

const char* name_of(ComponentAction action) noexcept {
  switch (action) {
    case ComponentAction::start:
      return "start";
    case ComponentAction::stop:
      return "stop";
    case ComponentAction::initialise:
      return "initialise";
  }
  return "unknown";
}

Status ComponentActions::run(ComponentAction action, ComponentIndex component) {
  if (component >= cell_->component_count())
    return Status::error(StatusCode::not_found, "there is no component number %u",
                         static_cast<unsigned>(component));
  if (const Status status = cell_->control().check_running(); !status) return status;
  switch (action) {
    case ComponentAction::start:
      return start(component);
    case ComponentAction::stop:
      return stop(component);
    case ComponentAction::initialise:
      return initialise(component);
  }
  return {};
}

Status ComponentActions::start(ComponentIndex component) {
  if (life(component) == Life::running)
    return Status::error(StatusCode::not_permitted, "%s runs already; initialise it to have it begin anew",
                         cell_->component_name(component));
  std::vector<ComponentIndex> wanted = stands_on(component);
  wanted.push_back(component);
  for (const ComponentIndex one : wanted) {
    if (life(one) == Life::running) continue;
    if (const Status status = initialise(one); !status) return status;
  }
  return {};
}

Status ComponentActions::stop(ComponentIndex component) {
  const ComponentIndex only[] = {component};
  for (const ComponentIndex owner : host_.owners_of(only)) {
    if (const Status status = stop_one(owner); !status) return status;
  }
  // In fault it is nobody's owner, but it can be stopped all the same.
  return life(component) == Life::fault ? stop_one(component) : Status{};
}

Status ComponentActions::initialise(ComponentIndex component) {
  const ComponentIndex only[] = {component};
  std::vector<ComponentIndex> again = host_.owners_of(only);
  if (const Status status = stop(component); !status) return status;
  cell_->control().require_start();
  if (std::find(again.begin(), again.end(), component) == again.end()) again.push_back(component);
  // What others stand on is initialised before them.
  Status first;
  for (std::size_t i = again.size(); i-- > 0;) {
    const Status status = start_one(again[i]);
    if (!status && life(again[i]) != Life::waiting) return status;
    // What stands on a device that is waited for is waited for as well.
    if (first) first = status;
  }
  return first;
}

Status ComponentActions::stop_one(ComponentIndex component) {
  const Status status = lifecycle_->stop(component);
  if (cell_->moves_something(component)) cell_->control().require_start();
  return status;
}

Status ComponentActions::start_one(ComponentIndex component) {
  // What it was in the middle of when it failed is nobody's to know.
  if (life(component) == Life::fault) {
    if (const Status status = cell_->renew(component); !status) return status;
  }
  return lifecycle_->start(component);
}

/// Buses before the devices on them, and before the buses on them.
std::vector<ComponentIndex> ComponentActions::stands_on(ComponentIndex component) const {
  const Application& application = cell_->application();
  std::vector<ComponentIndex> below;
  for (const std::uint16_t place : cell_->devices_of(component)) {
    const DeviceRecord& device = application.devices[place];
    for (std::uint16_t bus = device.bus; bus != no_index; bus = application.devices[bus].bus)
      below.insert(below.begin(), application.devices[bus].index);
    if (device.index != component) below.push_back(device.index);
  }
  return below;
}

std::vector<ComponentIndex> moving_components(const Cell& cell) {
  const Application& application = cell.application();
  std::vector<ComponentIndex> moving;
  for (std::size_t i = 0; i < application.units.size(); ++i) {
    const auto unit = static_cast<std::uint16_t>(i);
    const UnitState& state = application.unit_states[i];
    if (cell.moves_something(unit) && state.life.load(std::memory_order_acquire) == Life::running &&
        !state.idle.load(std::memory_order_acquire)) {
      moving.push_back(unit);
    }
  }
  for (std::size_t i = 0; i < application.devices.size(); ++i) {
    const auto device = static_cast<std::uint16_t>(i);
    const DeviceState& state = application.device_states[i];
    if (!cell.driver(device).actuates) continue;
    const bool may_move =
        state.life.load(std::memory_order_acquire) == Life::running && !state.device->is_inhibited();
    const bool comes_to_rest =
        state.make_safe.load(std::memory_order_acquire) && !state.safe.load(std::memory_order_acquire);
    if (may_move || comes_to_rest) moving.push_back(application.devices[i].index);
  }
  return moving;
}

}  // namespace flexrf
