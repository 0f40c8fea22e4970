#include "web-ui/server/access/one_time_token.hpp"

#include <sodium.h>

namespace flexrf::panel {

OneTimeToken::OneTimeToken() {
  std::array<unsigned char, digits / 2> secret;
  randombytes_buf(secret.data(), secret.size());
  sodium_bin2hex(text_.data(), text_.size(), secret.data(), secret.size());
  sodium_memzero(secret.data(), secret.size());
}

OneTimeToken::~OneTimeToken() {
  sodium_memzero(text_.data(), text_.size());
}

bool OneTimeToken::use(std::string_view text) noexcept {
  if (is_used_ || text.size() != digits || sodium_memcmp(text.data(), text_.data(), digits) != 0)
    return false;
  is_used_ = true;
  sodium_memzero(text_.data(), text_.size());
  return true;
}

}  // namespace flexrf::panel
