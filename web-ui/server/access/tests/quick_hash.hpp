// For tests that check passwords again and again: what a hash costs is up to itself.
#pragma once

#include <sodium.h>

#include <array>
#include <cstdlib>
#include <string>
#include <string_view>

namespace flexrf::panel {

/// As hash_password(), for a thousandth of the time and 8 KiB of memory; checking it costs as little. Not for
/// tests of what a person's password costs.
inline std::string quick_hash(std::string_view password) {
  std::array<char, crypto_pwhash_STRBYTES> text{};
  if (crypto_pwhash_str(text.data(), password.data(), password.size(), crypto_pwhash_OPSLIMIT_MIN,
                        crypto_pwhash_MEMLIMIT_MIN) != 0)
    std::abort();
  return text.data();
}

}  // namespace flexrf::panel
