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

std::vector<std::vector<SlotInput>> readers_of_slots(const Application& application) {
  std::vector<std::vector<SlotInput>> readers(application.slots.size());
  for (std::size_t u = 0; u < application.units.size(); ++u) {
    const UnitRecord& unit = application.units[u];
    const std::vector<const char*> names = input_names(*unit.type);
    for (std::size_t input = 0; input < unit.binding.inputs.size(); ++input) {
      const InputBinding& binding = unit.binding.inputs[input];
      for (std::uint32_t member = 0; member < binding.count; ++member) {
        const SlotControl* const control = binding.readers[member].slot();
        const auto slot =
            std::find_if(application.slots.begin(), application.slots.end(),
                         [control](const SlotRecord& record) { return record.control == control; });
        if (slot == application.slots.end()) continue;
        const std::string name = std::string{unit.name} + "." + (input < names.size() ? names[input] : "?");
        readers[static_cast<std::size_t>(slot - application.slots.begin())].push_back(
            {name, static_cast<std::uint16_t>(u), static_cast<std::uint16_t>(input), member});
      }
    }
  }
  return readers;
}

}  // namespace flexrf
