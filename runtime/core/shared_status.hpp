// A status that one thread publishes while others read it.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "base/status.hpp"

namespace flexrf {

/// Readers copy it whole at any time, from any thread, and never keep the writer waiting. At any one time one
/// thread may publish: who that is changes hands with the owner of what the status is about. Neither side
/// allocates.
///
/// A sequence lock after Boehm, "Can seqlocks get along with programming language memory models?" (2012),
/// without its fences: each word is stored with release and loaded with acquire, so that a reader that saw
/// one new word also sees the odd stamp that announced it.
class SharedStatus {
 public:
  void publish(const Status& status) noexcept {
    std::array<std::uint64_t, word_count> words{};
    std::memcpy(words.data(), &status, sizeof(status));
    const std::uint64_t stamp = stamp_.load(std::memory_order_relaxed);
    stamp_.store(stamp + 1, std::memory_order_relaxed);
    for (std::size_t i = 0; i < word_count; ++i) words_[i].store(words[i], std::memory_order_release);
    stamp_.store(stamp + 2, std::memory_order_release);
  }

  /// The last one that was published, or ok. Repeats while a publication is under way, which takes less than
  /// a microsecond unless the writer is preempted in it: not for a thread that may preempt the writer on its
  /// CPU.
  Status read() const noexcept {
    std::array<std::uint64_t, word_count> words{};
    while (!try_read(words)) {
    }
    Status status;
    std::memcpy(static_cast<void*>(&status), words.data(), sizeof(status));
    return status;
  }

 private:
  static_assert(std::is_trivially_copyable_v<Status>);
  static constexpr std::size_t word_count = (sizeof(Status) + 7) / 8;

  bool try_read(std::array<std::uint64_t, word_count>& words) const noexcept {
    const std::uint64_t stamp = stamp_.load(std::memory_order_acquire);
    if (stamp % 2 != 0) return false;
    for (std::size_t i = 0; i < word_count; ++i) words[i] = words_[i].load(std::memory_order_acquire);
    return stamp_.load(std::memory_order_relaxed) == stamp;
  }

  std::atomic<std::uint64_t> stamp_{0};  ///< twice the publications so far; odd while one is under way
  std::array<std::atomic<std::uint64_t>, word_count> words_{};
};

}  // namespace flexrf
