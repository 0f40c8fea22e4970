#include "runtime/face/observed_slots.hpp"

#include <cstring>

namespace flexrf {

const ObservedSlot& ObservedSlots::read(std::uint16_t slot) {
  Cached& cached = slots_[slot];
  if (cached.turn == turn_) return cached.newest;
  cached.turn = turn_;
  ObservedSlot& newest = cached.newest;
  if (cell_->application().slots[slot].observer == nullptr) {
    newest.reason = NullReason::not_registered;
    return newest;
  }
  if (cached.bytes.size() != size(slot)) cached.bytes.resize(size(slot));
  newest = look_at(*cell_, slot, [&](const ItemHeader& header, const void* payload) {
    if (header.sequence != newest.header.sequence)
      std::memcpy(cached.bytes.data(), payload, cached.bytes.size());
  });
  if (newest.header.sequence != 0) newest.last = cached.bytes.data();
  if (newest.reason == NullReason::none) newest.value = newest.last;
  return newest;
}

ObservedSlot ObservedSlots::read_header(std::uint16_t slot) {
  return look_at(*cell_, slot, [](const ItemHeader&, const void*) {});
}

}  // namespace flexrf
