// What a script may see of the cell: names, slots, parameters, and the figures of queues and threads.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "runtime/face/component_values.hpp"
#include "runtime/face/statistics.hpp"
#include "units/remote_control/rpc.hpp"

namespace flexrf::remote {

/// The unit's thread. Looks as the observer does, with its lock; what it looks at it copies.
class RemoteView {
 public:
  /// Bytes of a value; what is larger, and pictures, is for the panel.
  static constexpr std::size_t largest_value = 16 * 1024;

  explicit RemoteView(const Cell& cell)
      : directory_(cell), slots_(cell), values_(cell, directory_, slots_), statistics_(cell) {}

  RemoteView(const RemoteView&) = delete;
  RemoteView& operator=(const RemoteView&) = delete;

  /// From here on, each slot is read anew once.
  void begin_turn() noexcept { slots_.begin_turn(); }
  /// `room`: bytes that the whole answer may have.
  std::optional<RpcProblem> list(Fields& params, JsonWriter& json, std::size_t room);
  std::optional<RpcProblem> read(Fields& params, JsonWriter& json);

  std::optional<RpcProblem> find(Part part, std::string_view name, std::uint16_t& index) const;
  /// A slot whose values are for the panel.
  std::optional<RpcProblem> too_much(std::uint16_t slot) const;
  const SlotRecord& slot(std::uint16_t slot) const noexcept { return directory_.slots()[slot]; }
  const ComponentEntry& entry(ComponentIndex component) const noexcept { return directory_.entry(component); }

  const ObservedSlot& look(std::uint16_t slot) { return slots_.read(slot); }
  /// Members "name", "type", "reason", "sequence", "sampled_at_ns", "value" of an open object.
  void write_slot(JsonWriter& json, std::uint16_t slot, const ObservedSlot& seen) const;
  /// Runtime parameters in force: their sequence and an object of them.
  void write_runtime(JsonWriter& json, ComponentIndex component);

 private:
  Directory directory_;
  ObservedSlots slots_;
  ComponentValues values_;
  Statistics statistics_;
};

}  // namespace flexrf::remote
