#include "web-ui/server/access/password.hpp"

#include <sodium.h>

#include <algorithm>
#include <array>
#include <charconv>

namespace flexrf::panel {
namespace {

static_assert(crypto_pwhash_MEMLIMIT_INTERACTIVE == password_memory);
static_assert(crypto_pwhash_STRBYTES == longest_hash + 1);

constexpr unsigned long long passes = crypto_pwhash_OPSLIMIT_INTERACTIVE;
constexpr std::size_t salt_digits = 22;  // 16 bytes
constexpr std::size_t hash_digits = 43;  // 32 bytes

bool skip(std::string_view& text, std::string_view part) noexcept {
  if (!text.starts_with(part)) return false;
  text.remove_prefix(part.size());
  return true;
}

bool skip_number(std::string_view& text, unsigned long long largest) noexcept {
  unsigned long long number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || number == 0 || number > largest) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

bool skip_base64(std::string_view& text, std::size_t digits) noexcept {
  const auto is_digit = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '+' || c == '/';
  };
  if (text.size() < digits || !std::all_of(text.begin(), text.begin() + digits, is_digit)) return false;
  text.remove_prefix(digits);
  return true;
}

}  // namespace

Status check_password(std::string_view password) {
  const auto characters =
      static_cast<std::size_t>(std::count_if(password.begin(), password.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
      }));
  if (characters < shortest_password)
    return Status::error(StatusCode::invalid_argument, "a password has at least %zu characters",
                         shortest_password);
  if (password.size() > longest_password)
    return Status::error(StatusCode::invalid_argument, "a password has at most %zu bytes", longest_password);
  if (std::any_of(password.begin(), password.end(),
                  [](char c) { return static_cast<unsigned char>(c) < 0x20; }))
    return Status::error(StatusCode::invalid_argument, "a password has no control characters");
  return {};
}

Result<std::string> hash_password(std::string_view password) {
  std::array<char, crypto_pwhash_STRBYTES> text{};
  if (crypto_pwhash_str(text.data(), password.data(), password.size(), passes, password_memory) != 0)
    return Status::error(StatusCode::unavailable,
                         "hashing a password takes %zu MiB of memory, which are not there",
                         password_memory >> 20);
  return std::string{text.data()};
}

bool is_password_hash(std::string_view text) noexcept {
  return text.size() <= longest_hash && skip(text, "$argon2id$v=19$m=") &&
         skip_number(text, password_memory >> 10) && skip(text, ",t=") && skip_number(text, passes) &&
         skip(text, ",p=1$") && skip_base64(text, salt_digits) && skip(text, "$") &&
         skip_base64(text, hash_digits) && text.empty();
}

bool is_right_password(const std::string& hash, std::string_view password) noexcept {
  return is_password_hash(hash) &&
         crypto_pwhash_str_verify(hash.c_str(), password.data(), password.size()) == 0;
}

}  // namespace flexrf::panel
