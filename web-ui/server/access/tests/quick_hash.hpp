// Cheap password hashes for tests. A hash says itself how much work a check of it takes.
#pragma once

#include <sodium.h>

#include <array>
#include <cstdlib>
#include <string>
#include <string_view>

namespace flexrf::panel {

/// Makes a hash of the same kind as hash_password(), with the least work and 8 KiB of memory that libsodium
/// allows. A check of it is as cheap. Not for tests of the real cost.
inline std::string quick_hash(std::string_view password) {
  std::array<char, crypto_pwhash_STRBYTES> text{};
  if (crypto_pwhash_str(text.data(), password.data(), password.size(), crypto_pwhash_OPSLIMIT_MIN,
                        crypto_pwhash_MEMLIMIT_MIN) != 0)
    std::abort();
  return text.data();
}

}  // namespace flexrf::panel
