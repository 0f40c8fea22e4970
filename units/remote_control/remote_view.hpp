// What a script may see of the cell: names, slots, parameters.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "runtime/executive/cell.hpp"
#include "units/remote_control/rpc.hpp"

namespace flexrf::remote {

/// A slot's newest item, or the NULL item with its reason.
struct SlotLook {
  std::uint64_t sequence = 0;
  Time sampled_at{};
  NullReason reason = NullReason::nothing_yet;
  const void* value = nullptr;  ///< null unless reason is none; valid until the next look
};

/// The unit's thread. Looks as the observer does, with its lock; what it looks at it copies.
class RemoteView {
 public:
  /// Bytes of a value; what is larger, and pictures, is for the panel.
  static constexpr std::size_t largest_value = 16 * 1024;

  explicit RemoteView(const Cell& cell) noexcept : cell_(&cell) {}

  /// `room`: bytes that the whole answer may have.
  std::optional<RpcProblem> list(Fields& params, JsonWriter& json, std::size_t room);
  std::optional<RpcProblem> read(Fields& params, JsonWriter& json);

  std::optional<RpcProblem> find_slot(std::string_view name, std::uint16_t& slot) const;
  std::optional<RpcProblem> find_component(std::string_view name, ComponentIndex& component) const;

  SlotLook look(std::uint16_t slot);
  /// Members "name", "type", "reason", "sequence", "sampled_at_ns", "value" of an open object.
  void write_slot(JsonWriter& json, std::uint16_t slot, const SlotLook& seen) const;
  /// Runtime parameters in force: their sequence and an object of them.
  void write_runtime(JsonWriter& json, ComponentIndex component);

 private:
  const Application& application() const noexcept { return cell_->application(); }
  /// Of a component's runtime parameters or feedback; no_index: none, or not observed.
  std::uint16_t slot_of(ComponentIndex component, bool feedback) const noexcept;
  void write_block(JsonWriter& json, const char* key, std::uint16_t slot, const TypeDescriptor* type,
                   bool with_sequence);
  void write_component(JsonWriter& json, ComponentIndex component);
  void list_parameter(JsonWriter& json, const char* kind, const ParameterDescriptor& parameter) const;

  const Cell* cell_;
  std::vector<std::byte> bytes_;
};

}  // namespace flexrf::remote
