// One entry of a ring that its writer may overwrite while a reader copies it: a sequence lock per entry.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "runtime/blackboard/item.hpp"

namespace flexrf {

/// [stamp | sequence | sampled_at | value, rounded up to whole words], all of them atomic. The stamp is twice
/// the entry's position in its ring, plus one while it is being written, so that a reader that knows the
/// position it wants sees at once that the writer has lapped it.
///
/// After Boehm, "Can seqlocks get along with programming language memory models?" (2012), without its fences:
/// each word is stored with release and loaded with acquire (plain moves on x86). A reader that saw one new
/// word therefore also sees the stamp that announced it, and refuses the copy.
class RingEntry {
 public:
  static constexpr std::size_t words(std::size_t value_size) noexcept { return 3 + (value_size + 7) / 8; }

  static void write(std::atomic<std::uint64_t>* entry, std::uint64_t position, const ItemHeader& header,
                    const void* value, std::size_t size) noexcept {
    entry[0].store(position * 2 + 1, std::memory_order_relaxed);
    entry[1].store(header.sequence, std::memory_order_release);
    entry[2].store(static_cast<std::uint64_t>(nanoseconds(header.sampled_at)), std::memory_order_release);
    const auto* from = static_cast<const std::byte*>(value);
    std::atomic<std::uint64_t>* to = entry + 3;
    for (std::size_t left = size; left > 0; ++to) {
      const std::size_t part = left < sizeof(std::uint64_t) ? left : sizeof(std::uint64_t);
      std::uint64_t word = 0;
      std::memcpy(&word, from, part);
      to->store(word, std::memory_order_release);
      from += part;
      left -= part;
    }
    entry[0].store(position * 2, std::memory_order_release);
  }

  /// The time of the entry at `position`; false when it was overwritten.
  static bool read_time(const std::atomic<std::uint64_t>* entry, std::uint64_t position,
                        Time& time) noexcept {
    if (entry[0].load(std::memory_order_acquire) != position * 2) return false;
    time = Time{Duration{static_cast<std::int64_t>(entry[2].load(std::memory_order_acquire))}};
    return entry[0].load(std::memory_order_relaxed) == position * 2;
  }

  /// Copies the entry at `position`; false when it was overwritten, also in the middle (the copy is then
  /// void).
  static bool read(const std::atomic<std::uint64_t>* entry, std::uint64_t position, ItemHeader& header,
                   void* value, std::size_t size) noexcept {
    if (entry[0].load(std::memory_order_acquire) != position * 2) return false;
    header.sequence = entry[1].load(std::memory_order_acquire);
    header.sampled_at = Time{Duration{static_cast<std::int64_t>(entry[2].load(std::memory_order_acquire))}};
    auto* to = static_cast<std::byte*>(value);
    const std::atomic<std::uint64_t>* from = entry + 3;
    for (std::size_t left = size; left > 0; ++from) {
      const std::size_t part = left < sizeof(std::uint64_t) ? left : sizeof(std::uint64_t);
      const std::uint64_t word = from->load(std::memory_order_acquire);
      std::memcpy(to, &word, part);
      to += part;
      left -= part;
    }
    return entry[0].load(std::memory_order_relaxed) == position * 2;
  }
};

}  // namespace flexrf
