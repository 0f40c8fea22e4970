// The parameters of a component as JSON.
#pragma once

#include <cstdint>
#include <vector>

#include "base/json_writer.hpp"
#include "runtime/face/directory.hpp"
#include "runtime/face/observed_slots.hpp"

namespace flexrf {

/// One thread's, which is not real-time. What a component has none of is {}; what is not known yet is null.
class ComponentValues {
 public:
  ComponentValues(const Cell& cell, const Directory& directory, ObservedSlots& slots) noexcept
      : cell_(&cell), directory_(&directory), slots_(&slots) {}

  /// Sequence of the runtime parameters in force; 0: none.
  std::uint64_t sequence(ComponentIndex component);
  /// Each writes one value.
  void write_runtime(JsonWriter& json, ComponentIndex component);
  void write_feedback(JsonWriter& json, ComponentIndex component);
  void write_configuration(JsonWriter& json, ComponentIndex component);
  /// Members "sequence", "configuration", "runtime" and "feedback".
  void write_all(JsonWriter& json, ComponentIndex component);

 private:
  void write_slot(JsonWriter& json, std::uint16_t slot, const TypeDescriptor* type);

  const Cell* cell_;
  const Directory* directory_;
  ObservedSlots* slots_;
  std::vector<std::byte> bytes_;
};

}  // namespace flexrf
