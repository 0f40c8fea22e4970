#include "runtime/face/slot_readers.hpp"

#include <algorithm>

namespace flexrf {
namespace {

/// Names of the type's inputs of slots, in the order of the table.
std::vector<const char*> input_names(const ComponentType& type) {
  std::vector<const char*> names;
  for (const PortDescriptor& port : type.ports) {
    if (port.direction == PortDescriptor::Direction::input) names.push_back(port.name);
  }
  return names;
}

}  // namespace

std::uint16_t index_of(const Application& application, const SlotControl* control) noexcept {
  const auto found = std::ranges::find(application.slots, control, &SlotRecord::control);
  return found == application.slots.end() ? no_index
                                          : static_cast<std::uint16_t>(found - application.slots.begin());
}

std::vector<std::vector<SlotInput>> readers_of_slots(const Cell& cell) {
  const Application& application = cell.application();
  std::vector<std::vector<SlotInput>> readers(application.slots.size());
  for (ComponentIndex component = 0; component < cell.component_count(); ++component) {
    const std::span<const InputBinding> inputs = cell.ports(component).inputs;
    const std::vector<const char*> names = input_names(cell.component_type(component));
    for (std::size_t input = 0; input < inputs.size(); ++input) {
      for (std::uint32_t member = 0; member < inputs[input].count; ++member) {
        const std::uint16_t slot = index_of(application, inputs[input].readers[member].slot());
        if (slot == no_index) continue;
        const std::string name =
            std::string{cell.component_name(component)} + "." + (input < names.size() ? names[input] : "?");
        readers[slot].push_back({name, &cell, component, static_cast<std::uint16_t>(input), member});
      }
    }
  }
  return readers;
}

}  // namespace flexrf
