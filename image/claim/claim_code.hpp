// The code on a new PC's console: whoever types it at the panel stood before the PC.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace flexrf::claim {

/// 50 random bits as ten characters, of which none is taken for another (Crockford's base 32).
class ClaimCode {
 public:
  static constexpr std::size_t digits = 10;

  /// A new one. prepare_cryptography() went well before.
  ClaimCode() noexcept;
  ~ClaimCode();
  ClaimCode(const ClaimCode&) = default;
  ClaimCode& operator=(const ClaimCode&) = default;

  /// As it is shown: "7QK2M-9XR4T".
  std::string text() const;
  /// Small letters are the same, O is 0, I and L are 1, spaces and dashes do not count. Compares in constant
  /// time.
  bool is(std::string_view typed) const noexcept;

 private:
  std::array<char, digits> code_{};
};

}  // namespace flexrf::claim
