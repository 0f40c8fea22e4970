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

std::vector<std::vector<SlotInput>> readers_of_slots(const Application& application) {
  std::vector<std::vector<SlotInput>> readers(application.slots.size());
  for (std::size_t u = 0; u < application.units.size(); ++u) {
    const UnitRecord& unit = application.units[u];
    const std::vector<const char*> names = input_names(*unit.type);
    for (std::size_t input = 0; input < unit.binding.inputs.size(); ++input) {
      const InputBinding& binding = unit.binding.inputs[input];
      for (std::uint32_t member = 0; member < binding.count; ++member) {
        const std::uint16_t slot = index_of(application, binding.readers[member].slot());
        if (slot == no_index) continue;
        const std::string name = std::string{unit.name} + "." + (input < names.size() ? names[input] : "?");
        readers[slot].push_back(
            {name, &application.unit_states[u], static_cast<std::uint16_t>(input), member});
      }
    }
  }
  return readers;
}

}  // namespace flexrf
