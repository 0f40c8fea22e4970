#include "runtime/face/observed_slots.hpp"

#include <cstring>

namespace flexrf {

NullReason reason_of(const SlotRecord& record, const ItemHeader& header) noexcept {
  const NullReason reason = null_reason_of(record.control->writer_state());
  return reason == NullReason::none && header.sequence == 0 ? NullReason::nothing_yet : reason;
}

const ObservedSlot& ObservedSlots::read(std::uint16_t slot) {
  Cached& cached = slots_[slot];
  if (cached.turn == turn_) return cached.newest;
  cached.turn = turn_;
  const SlotRecord& record = cell_->application().slots[slot];
  ObservedSlot& newest = cached.newest;
  newest.value = nullptr;
  if (record.observer == nullptr) {
    newest.reason = NullReason::not_registered;
    return newest;
  }
  const std::size_t size = record.control->type()->size;
  if (cached.bytes.size() != size) cached.bytes.resize(size);
  {
    const auto lock = cell_->observe();
    const ItemHeader* const header = record.observer->newest();
    if (header != nullptr && header->sequence != newest.header.sequence) {
      std::memcpy(cached.bytes.data(), record.observer->payload(), size);
      newest.header = *header;
    }
  }
  newest.reason = reason_of(record, newest.header);
  if (newest.header.sequence != 0) newest.last = cached.bytes.data();
  if (newest.reason == NullReason::none) newest.value = newest.last;
  return newest;
}

ObservedSlot ObservedSlots::read_header(std::uint16_t slot) {
  const SlotRecord& record = cell_->application().slots[slot];
  ObservedSlot newest;
  {
    const auto lock = cell_->observe();
    const ItemHeader* const header = record.observer->newest();
    if (header != nullptr) newest.header = *header;
  }
  newest.reason = reason_of(record, newest.header);
  return newest;
}

}  // namespace flexrf
