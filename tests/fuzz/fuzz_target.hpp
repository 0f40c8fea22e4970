// What a fuzz target consists of. fuzz_main.cpp makes an executable of it.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <span>
#include <string_view>
#include <vector>

namespace flexrf::fuzz {

using Bytes = std::vector<std::uint8_t>;

/// Each target: what it begins with, so that what is deep inside is reached soon.
std::vector<Bytes> seeds();
/// Each target: any bytes at all.
void take(std::span<const std::uint8_t> bytes);

/// What has to hold for all bytes; else they are kept as a crash.
inline void expect(bool holds) {
  if (!holds) std::abort();
}

inline Bytes bytes_of(std::string_view text) {
  return {text.begin(), text.end()};
}

/// Bytes from the front of the input; zeros when there are no more.
class Source {
 public:
  explicit Source(std::span<const std::uint8_t> bytes) : left_(bytes) {}

  bool is_empty() const { return left_.empty(); }
  std::uint8_t byte() {
    if (left_.empty()) return 0;
    const std::uint8_t byte = left_.front();
    left_ = left_.subspan(1);
    return byte;
  }
  std::uint16_t word() {
    const std::uint8_t low = byte();
    return static_cast<std::uint16_t>(low | byte() << 8);
  }
  /// Fewer than `most` at the end.
  std::span<const std::uint8_t> some(std::size_t most) {
    const std::size_t size = most < left_.size() ? most : left_.size();
    const std::span<const std::uint8_t> taken = left_.first(size);
    left_ = left_.subspan(size);
    return taken;
  }

 private:
  std::span<const std::uint8_t> left_;
};

}  // namespace flexrf::fuzz
