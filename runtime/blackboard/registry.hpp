// Registry: what is on the blackboard, by name. Observer's reading: any slot, without its C++ type.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "runtime/blackboard/ports.hpp"

namespace flexrf {

/// One slot under its name.
struct RegistryEntry {
  const char* name;
  SlotControl* slot;
  SlotReader* observer;  ///< the observer's reader; null when the slot is not observed
};

/// What an untyped read gives: the value's bytes with their provenance, or the NULL item with its reason.
/// Valid until the same slot is read again.
struct Observation {
  const void* value = nullptr;  ///< null unless reason is none
  const TypeDescriptor* type = nullptr;
  ItemHeader header{};
  NullReason reason = NullReason::not_registered;
  Freshness freshness = Freshness::null;
};

/// Finds slots by name. Looks through all of them: for start-up, tests and the observer, not for steps.
class Registry {
 public:
  constexpr explicit Registry(std::span<const RegistryEntry> entries) noexcept : entries_(entries) {}

  /// Null when there is no slot of this name. Any thread.
  const RegistryEntry* find(std::string_view name) const noexcept;
  /// As find(), of this very type (by the descriptor's hash): the slot, or null with the reason
  /// (not_registered, wrong_type).
  SlotControl* find(std::string_view name, const TypeDescriptor& type, NullReason& reason) const noexcept;

  /// Reads as the observer. The observer's thread only. `type` null: any type. `seen` is the sequence seen
  /// before in this slot (0: none) and is replaced; it tells new from old.
  Observation read(std::string_view name, const TypeDescriptor* type, std::uint64_t& seen) const noexcept;
  static Observation read(const RegistryEntry& entry, std::uint64_t& seen) noexcept;

 private:
  std::span<const RegistryEntry> entries_;
};

}  // namespace flexrf
