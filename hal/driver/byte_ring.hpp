// ByteRing: bytes on their way out, in a bounded memory.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <string_view>

namespace flexrf {

/// One thread.
class ByteRing {
 public:
  /// Empties it; the memory outlives the ring.
  void use(std::span<char> memory) noexcept {
    memory_ = memory;
    clear();
  }
  void clear() noexcept { first_ = size_ = 0; }

  bool is_empty() const noexcept { return size_ == 0; }
  std::size_t size() const noexcept { return size_; }
  std::size_t room() const noexcept { return memory_.size() - size_; }

  /// All or nothing.
  bool put(std::string_view bytes) noexcept {
    if (bytes.size() > room()) return false;
    while (!bytes.empty()) {
      const std::size_t at = (first_ + size_) % memory_.size();
      const std::size_t count = std::min(bytes.size(), memory_.size() - at);
      std::copy_n(bytes.data(), count, memory_.data() + at);
      size_ += count;
      bytes.remove_prefix(count);
    }
    return true;
  }
  /// The oldest bytes, as many as lie in one piece.
  std::string_view front() const noexcept {
    return {memory_.data() + first_, std::min(size_, memory_.size() - first_)};
  }
  /// `count`: at most what front() gave.
  void drop(std::size_t count) noexcept {
    first_ = (first_ + count) % memory_.size();
    size_ -= count;
  }

 private:
  std::span<char> memory_;
  std::size_t first_ = 0;
  std::size_t size_ = 0;
};

}  // namespace flexrf
