#include "runtime/blackboard/registry.hpp"

namespace flexrf {

const RegistryEntry* Registry::find(std::string_view name) const noexcept {
  for (const RegistryEntry& entry : entries_) {
    if (name == entry.name) return &entry;
  }
  return nullptr;
}

SlotControl* Registry::find(std::string_view name, const TypeDescriptor& type,
                            NullReason& reason) const noexcept {
  const RegistryEntry* entry = find(name);
  reason = NullReason::none;
  if (entry == nullptr) {
    reason = NullReason::not_registered;
  } else if (entry->slot->type()->hash != type.hash) {
    reason = NullReason::wrong_type;
  }
  return reason == NullReason::none ? entry->slot : nullptr;
}

Observation Registry::read(std::string_view name, const TypeDescriptor* type,
                           std::uint64_t& seen) const noexcept {
  const RegistryEntry* entry = find(name);
  if (entry == nullptr) return {};
  if (type != nullptr && entry->slot->type()->hash != type->hash) {
    Observation refused;
    refused.type = entry->slot->type();
    refused.reason = NullReason::wrong_type;
    return refused;
  }
  return read(*entry, seen);
}

Observation Registry::read(const RegistryEntry& entry, std::uint64_t& seen) noexcept {
  Observation observation;
  observation.type = entry.slot->type();
  if (entry.observer == nullptr) return observation;
  const ItemHeader* header = entry.observer->newest();
  observation.reason = null_reason_of(entry.slot->writer_state());
  if (observation.reason != NullReason::none) return observation;
  if (header == nullptr) {
    observation.reason = NullReason::nothing_yet;
    return observation;
  }
  observation.value = entry.observer->payload();
  observation.header = *header;
  observation.freshness = header->sequence == seen ? Freshness::old_item : Freshness::new_item;
  seen = header->sequence;
  return observation;
}

}  // namespace flexrf
