// History: the last K values of a slot, to be asked what was at a time.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

#include "runtime/blackboard/item.hpp"
#include "runtime/core/type_descriptor.hpp"

namespace flexrf {

/// A ring of K entries of relaxed atomic words with a sequence each (a sequence lock per entry). The writer
/// appends in bounded time whatever readers do; a reader copies an entry, tries at most twice, then answers
/// NULL.
///
/// append: the writer's thread. at, between: any thread.
class History {
 public:
  /// Words per entry: sequence, sampled_at, then the value rounded up to whole words.
  static constexpr std::size_t words_per_entry(std::size_t value_size) noexcept {
    return 2 + (value_size + 7) / 8;
  }

  constexpr History(const TypeDescriptor* type, std::atomic<std::uint64_t>* words,
                    std::uint32_t capacity) noexcept
      : type_(type), words_(words), capacity_(capacity) {}
  History(const History&) = delete;
  History& operator=(const History&) = delete;

  void append(const ItemHeader& header, const void* value) noexcept;

  /// Copies the newest entry with sampled_at <= time into `value` (type()->size bytes). The reason when there
  /// is none: nothing_yet, no_longer_kept (older than the oldest kept, or overwritten while being read).
  NullReason at(Time time, ItemHeader& header, void* value) const noexcept;

  /// Copies the entries with from <= sampled_at <= to, oldest first, at most `capacity` of them, into
  /// `values` (type()->size bytes apart). Returns how many. Entries overwritten meanwhile are left out.
  std::size_t between(Time from, Time to, std::span<ItemHeader> headers, void* values) const noexcept;

  const TypeDescriptor* type() const noexcept { return type_; }
  std::uint32_t capacity() const noexcept { return capacity_; }

 private:
  const TypeDescriptor* type_;
  std::atomic<std::uint64_t>* words_;
  std::uint32_t capacity_;
  std::atomic<std::uint64_t> appended_{0};
};

}  // namespace flexrf
