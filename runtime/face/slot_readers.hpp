// Who reads which slot, by name, for whoever shows it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/executive/application.hpp"

namespace flexrf {

/// An input of a unit that reads a slot.
struct SlotInput {
  std::string name;  ///< "unit.port"
  const UnitState* unit;
  std::uint16_t input;   ///< of the unit's slots, in the order of its table
  std::uint32_t member;  ///< of a range

  /// What it read since the unit was constructed; nothing while there is no unit. Any thread.
  InputCounters counters() const noexcept {
    return unit->unit == nullptr ? InputCounters{} : unit->unit->input_counters(input, member);
  }
};

/// In Application::slots; no_index: it is none of them.
std::uint16_t index_of(const Application& application, const SlotControl* control) noexcept;
/// Of each slot, in the order of the tables. When everything is constructed; allocates.
std::vector<std::vector<SlotInput>> readers_of_slots(const Application& application);

}  // namespace flexrf
