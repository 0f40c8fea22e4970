// The newest value of each slot, read once for all who want it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "runtime/executive/cell.hpp"

namespace flexrf {

/// A slot's newest item, or the NULL item with its reason.
struct ObservedSlot {
  ItemHeader header{};
  NullReason reason = NullReason::nothing_yet;
  const void* value = nullptr;  ///< null unless reason is none
  const void* last = nullptr;   ///< of the newest item, whatever became of its writer; null: there is none
};

/// Why a slot is NULL, for people; "": it is not. Of one that only another driver would write, which and of
/// what.
std::string reason_text(const Cell& cell, std::uint16_t slot, NullReason reason);

/// How often who subscribed to a slot is told of it, in values a second.
struct SlotRate {
  static constexpr double slowest = 0.01;
  static constexpr double fastest = 60;
  static constexpr double usual = 10;

  static constexpr bool is_possible(double rate) noexcept { return rate >= slowest && rate <= fastest; }
};

/// An observed slot as of now, without its values: `take(header, payload)` is called with the newest item, if
/// there is one, under the observer's lock, and copies what it wants. Any thread that is not real-time.
template <class Take>
ObservedSlot look_at(const Cell& cell, std::uint16_t slot, Take&& take) {
  const SlotRecord& record = cell.application().slots[slot];
  ObservedSlot seen;
  {
    const auto lock = cell.observe();
    if (const ItemHeader* const newest = record.observer->newest(); newest != nullptr) {
      seen.header = *newest;
      take(*newest, record.observer->payload());
    }
  }
  seen.reason = null_reason_of(record.control->writer_state());
  if (seen.reason == NullReason::none && seen.header.sequence == 0) seen.reason = NullReason::nothing_yet;
  return seen;
}

/// One thread's, which is not real-time. Memory for a slot's value is allocated when it is first asked for.
class ObservedSlots {
 public:
  explicit ObservedSlots(const Cell& cell) : cell_(&cell), slots_(cell.application().slots.size()) {}

  /// From here on, each slot is read anew once.
  void begin_turn() noexcept { ++turn_; }
  std::uint64_t turn() const noexcept { return turn_; }
  /// As of this turn. Not for slots of images. Valid until the slot is read in another turn.
  const ObservedSlot& read(std::uint16_t slot);
  /// Of an observed slot whose value is had in another way, as a picture is: all but the values, as of now.
  ObservedSlot read_header(std::uint16_t slot);
  /// Why the slot is NULL, as reason_text().
  std::string reason(std::uint16_t slot, const ObservedSlot& seen) const {
    return reason_text(*cell_, slot, seen.reason);
  }
  std::size_t size(std::uint16_t slot) const noexcept {
    return cell_->application().slots[slot].control->type()->size;
  }

 private:
  struct Cached {
    ObservedSlot newest;
    std::uint64_t turn = 0;
    std::vector<std::byte> bytes;
  };

  const Cell* cell_;
  std::uint64_t turn_ = 1;
  std::vector<Cached> slots_;
};

}  // namespace flexrf
