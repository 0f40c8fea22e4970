// Passwords: what is kept of them, and whether one is right (Argon2id, RFC 9106, by libsodium).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "base/status.hpp"

namespace flexrf::panel {

/// Computing a hash takes this much memory, and about 0.1 s: the "interactive" cost of libsodium. It is made
/// in processes of its own (flexrf-password, PasswordCheck), never in the application's.
inline constexpr std::size_t password_memory = std::size_t{64} << 20;

inline constexpr std::size_t shortest_password = 12;  ///< characters, of a new one
inline constexpr std::size_t longest_password = 256;  ///< bytes
inline constexpr std::size_t longest_hash = 127;      ///< bytes

/// invalid_argument: too short, too long, or with control characters.
Status check_password(std::string_view password);

/// A text with the cost and a salt in it, at most longest_hash. unavailable: no memory.
Result<std::string> hash_password(std::string_view password);

/// Whether it is a text that hash_password() could have made, at no higher cost.
bool is_password_hash(std::string_view text) noexcept;

/// False also when there is not enough memory.
bool is_right_password(const std::string& hash, std::string_view password) noexcept;

}  // namespace flexrf::panel
