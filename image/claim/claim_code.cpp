#include "image/claim/claim_code.hpp"

#include <sodium.h>

namespace flexrf::claim {
namespace {

constexpr std::string_view alphabet = "0123456789ABCDEFGHJKMNPQRSTVWXYZ";
static_assert(alphabet.size() == 32);

/// 0: it does not count.
char normal(char typed) noexcept {
  const char large = typed >= 'a' && typed <= 'z' ? static_cast<char>(typed - 'a' + 'A') : typed;
  switch (large) {
    case ' ':
    case '-':
      return 0;
    case 'O':
      return '0';
    case 'I':
    case 'L':
      return '1';
    default:
      return large;
  }
}

}  // namespace

ClaimCode::ClaimCode() noexcept {
  for (char& digit : code_) digit = alphabet[randombytes_uniform(alphabet.size())];
}

ClaimCode::~ClaimCode() {
  sodium_memzero(code_.data(), code_.size());
}

std::string ClaimCode::text() const {
  std::string text(code_.data(), code_.size());
  return text.insert(digits / 2, "-");
}

bool ClaimCode::is(std::string_view typed) const noexcept {
  std::array<char, digits> wanted{};
  std::size_t size = 0;
  for (const char one : typed) {
    const char character = normal(one);
    if (character == 0) continue;
    if (size == digits) return false;
    wanted[size++] = character;
  }
  return size == digits && sodium_memcmp(wanted.data(), code_.data(), digits) == 0;
}

}  // namespace flexrf::claim
