// The runtime values of one component as whoever saves them sees them: apart from the object they live in.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

#include "runtime/parameters/set_marks.hpp"

namespace flexrf {

/// One thread at a time publishes (the owner of the component), any thread that is not real-time reads; the
/// writer never waits. A sequence lock as SharedStatus.
class SettingsRecord {
 public:
  /// Allocates room for a struct of so many bytes and its marks. Before anybody publishes or reads.
  void reserve(std::size_t size) {
    size_ = size;
    word_count_ = (2 * size + sizeof(std::uint64_t) - 1) / sizeof(std::uint64_t);
    words_ = std::make_unique<std::atomic<std::uint64_t>[]>(word_count_);
  }
  std::size_t size() const noexcept { return size_; }

  void publish(const std::byte* values, const SetMarks& marks) noexcept {
    const std::uint64_t stamp = stamp_.load(std::memory_order_relaxed);
    stamp_.store(stamp + 1, std::memory_order_relaxed);
    for (std::size_t i = 0; i < word_count_; ++i) {
      std::byte word[sizeof(std::uint64_t)]{};
      for (std::size_t at = 0; at < sizeof(word); ++at)
        word[at] = byte_of(i * sizeof(word) + at, values, marks);
      std::uint64_t bits = 0;
      std::memcpy(&bits, word, sizeof(bits));
      words_[i].store(bits, std::memory_order_release);
    }
    stamp_.store(stamp + 2, std::memory_order_release);
  }

  /// The last that was published; nothing where there is none.
  void read(std::vector<std::byte>& values, SetMarks& marks) const {
    std::vector<std::uint64_t> words(word_count_);
    while (!try_read(words)) {
    }
    values.resize(size_);
    marks = SetMarks(size_);
    const auto* const bytes = reinterpret_cast<const std::byte*>(words.data());
    std::copy_n(bytes, size_, values.begin());
    std::transform(bytes + size_, bytes + 2 * size_, marks.flags().begin(),
                   [](std::byte flag) { return std::to_integer<std::uint8_t>(flag); });
  }

 private:
  std::byte byte_of(std::size_t index, const std::byte* values, const SetMarks& marks) const noexcept {
    if (index < size_) return values[index];
    return index < 2 * size_ ? std::byte{marks.flags()[index - size_]} : std::byte{0};
  }
  bool try_read(std::span<std::uint64_t> words) const noexcept {
    const std::uint64_t stamp = stamp_.load(std::memory_order_acquire);
    if (stamp % 2 != 0) return false;
    for (std::size_t i = 0; i < word_count_; ++i) words[i] = words_[i].load(std::memory_order_acquire);
    return stamp_.load(std::memory_order_relaxed) == stamp;
  }

  std::size_t size_ = 0;
  std::size_t word_count_ = 0;
  std::atomic<std::uint64_t> stamp_{0};  ///< twice the publications so far; odd while one is under way
  std::unique_ptr<std::atomic<std::uint64_t>[]> words_;
};

}  // namespace flexrf
