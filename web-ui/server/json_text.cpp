#include "web-ui/server/json_text.hpp"

#include <cstddef>
#include <cstdint>

namespace flexrf::panel {
namespace {

constexpr std::string_view replacement = "\xEF\xBF\xBD";  // U+FFFD

bool continues(std::string_view text, std::size_t at) noexcept {
  return at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U;
}

/// Bytes of the well-formed UTF-8 sequence that begins at `at`; 0: there is none (Unicode 15, table 3-7).
std::size_t sequence_at(std::string_view text, std::size_t at) noexcept {
  const auto first = static_cast<unsigned char>(text[at]);
  if (first < 0x80) return 1;
  if (first < 0xC2 || first > 0xF4 || !continues(text, at + 1)) return 0;
  const auto second = static_cast<unsigned char>(text[at + 1]);
  if (first < 0xE0) return 2;
  if (!continues(text, at + 2)) return 0;
  if (first < 0xF0) {
    const bool overlong = first == 0xE0 && second < 0xA0;
    const bool surrogate = first == 0xED && second > 0x9F;
    return overlong || surrogate ? 0 : 3;
  }
  const bool overlong = first == 0xF0 && second < 0x90;
  const bool too_large = first == 0xF4 && second > 0x8F;
  return overlong || too_large || !continues(text, at + 3) ? 0 : 4;
}

void append_control(std::string& json, char character) {
  constexpr std::string_view digits = "0123456789abcdef";
  const auto code = static_cast<unsigned char>(character);
  switch (character) {
    case '\n':
      json += "\\n";
      return;
    case '\r':
      json += "\\r";
      return;
    case '\t':
      json += "\\t";
      return;
    default:
      json += "\\u00";
      json += digits[code >> 4U];
      json += digits[code & 0xFU];
  }
}

}  // namespace

void append_json_text(std::string& json, std::string_view text) {
  json += '"';
  for (std::size_t i = 0; i < text.size();) {
    const char character = text[i];
    if (character == '"' || character == '\\') {
      json += '\\';
      json += character;
      ++i;
    } else if (static_cast<unsigned char>(character) < 0x20) {
      append_control(json, character);
      ++i;
    } else if (const std::size_t size = sequence_at(text, i); size > 0) {
      json.append(text, i, size);
      i += size;
    } else {
      json += replacement;
      ++i;
    }
  }
  json += '"';
}

}  // namespace flexrf::panel
