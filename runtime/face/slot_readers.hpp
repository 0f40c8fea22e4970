// Who reads which slot, by name, for whoever shows it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/executive/cell.hpp"

namespace flexrf {

/// An input of a unit or device that reads a slot.
struct SlotInput {
  std::string name;  ///< "unit.port", "device.port"
  const Cell* cell;
  ComponentIndex component;
  std::uint16_t input;   ///< of the component's slots, in the order of its table
  std::uint32_t member;  ///< of a range

  /// What it read since it was connected last. Any thread, while the cell is constructed.
  InputCounters counters() const noexcept { return cell->component(component).input_counters(input, member); }
};

/// In Application::slots; no_index: it is none of them.
std::uint16_t index_of(const Application& application, const SlotControl* control) noexcept;
/// Of each slot, in the order of the tables: units, then devices with the drivers that were chosen. When
/// everything is constructed; allocates.
std::vector<std::vector<SlotInput>> readers_of_slots(const Cell& cell);

}  // namespace flexrf
