// History: the last K values of a slot, to be asked what was at a time.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

#include "runtime/blackboard/item.hpp"
#include "runtime/blackboard/ring_entry.hpp"
#include "runtime/core/type_descriptor.hpp"

namespace flexrf {

/// A ring of K entries of atomic words with a sequence lock each. The writer appends in bounded time whatever
/// readers do; a reader looks from the newest entry back, at most 3 K loads, and copies the one it wants; it
/// tries at most twice, then answers NULL. Times need not ascend.
///
/// append: the writer's thread. at, between: any thread.
class History {
 public:
  static constexpr std::size_t words_per_entry(std::size_t value_size) noexcept {
    return RingEntry::words(value_size);
  }

  constexpr History(const TypeDescriptor* type, std::atomic<std::uint64_t>* words,
                    std::uint32_t capacity) noexcept
      : type_(type), words_(words), capacity_(capacity) {}
  History(const History&) = delete;
  History& operator=(const History&) = delete;

  void append(const ItemHeader& header, const void* value) noexcept;

  /// Copies the newest entry with sampled_at <= time into `value` (type()->size bytes). The reason when there
  /// is none: nothing_yet (no entry at all, or all are younger and none was dropped yet), no_longer_kept
  /// (older than the oldest kept, or overwritten while being read).
  NullReason at(Time time, ItemHeader& header, void* value) const noexcept;

  /// Copies the entries with from <= sampled_at <= to, oldest first, at most `capacity` of them, into
  /// `values` (type()->size bytes apart). Returns how many. Entries overwritten meanwhile are left out.
  std::size_t between(Time from, Time to, std::span<ItemHeader> headers, void* values) const noexcept;

  const TypeDescriptor* type() const noexcept { return type_; }
  std::uint32_t capacity() const noexcept { return capacity_; }

 private:
  std::atomic<std::uint64_t>* entry(std::uint64_t position) const noexcept {
    return words_ + position % capacity_ * words_per_entry(type_->size);
  }

  const TypeDescriptor* type_;
  std::atomic<std::uint64_t>* words_;
  std::uint32_t capacity_;
  std::atomic<std::uint64_t> appended_{0};
};

/// The memory of a history, for `.bss`: `static HistoryMemory<T, 64> memory; constinit History history{&type,
/// memory.words, 64};`
template <class T, std::size_t K>
struct HistoryMemory {
  static_assert(K >= 1);
  std::atomic<std::uint64_t> words[K * History::words_per_entry(sizeof(T))];
};

}  // namespace flexrf
