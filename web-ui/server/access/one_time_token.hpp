// The word in the printed address that makes its first visitor an admin.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace flexrf::panel {

/// 128 random bits, good for one use. The server's thread.
class OneTimeToken {
 public:
  static constexpr std::size_t digits = 32;

  OneTimeToken();
  ~OneTimeToken();
  OneTimeToken(const OneTimeToken&) = delete;
  OneTimeToken& operator=(const OneTimeToken&) = delete;

  /// For the address that is printed, never for a log that visitors can read. Empty once it was used.
  std::string_view text() const noexcept { return {text_.data(), is_used_ ? 0 : digits}; }
  /// True once, for the right text. Compares in constant time.
  bool use(std::string_view text) noexcept;

 private:
  std::array<char, digits + 1> text_{};
  bool is_used_ = false;
};

}  // namespace flexrf::panel
