#include "base/json_writer.hpp"

#include <charconv>
#include <cmath>

namespace flexrf {
namespace {

/// Bytes of the UTF-8 sequence at the text's beginning (RFC 3629); 0 when there is none.
std::size_t utf8_length(std::string_view text) noexcept {
  const auto byte = [text](std::size_t index) { return static_cast<unsigned char>(text[index]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < length) return 0;
  // The second byte's range leaves out overlong forms, surrogates and what is beyond U+10FFFF.
  const unsigned char low = first == 0xE0 ? 0xA0 : first == 0xF0 ? 0x90 : 0x80;
  const unsigned char high = first == 0xED ? 0x9F : first == 0xF4 ? 0x8F : 0xBF;
  if (byte(1) < low || byte(1) > high) return 0;
  for (std::size_t i = 2; i < length; ++i) {
    if (byte(i) < 0x80 || byte(i) > 0xBF) return 0;
  }
  return length;
}

}  // namespace

JsonWriter& JsonWriter::key(std::string_view name) {
  begin_value();
  write_text(name);
  text_ += style_ == Style::compact ? ":" : ": ";
  after_key_ = true;
  return *this;
}

JsonWriter& JsonWriter::value(std::string_view text) {
  begin_value();
  write_text(text);
  return *this;
}

JsonWriter& JsonWriter::value(bool value) {
  begin_value();
  text_ += value ? "true" : "false";
  return *this;
}

JsonWriter& JsonWriter::value(double number) {
  if (!std::isfinite(number)) return null();
  begin_value();
  char digits[32];
  text_.append(digits, std::to_chars(digits, digits + sizeof(digits), number).ptr);
  return *this;
}

JsonWriter& JsonWriter::signed_value(std::int64_t number) {
  begin_value();
  char digits[24];
  text_.append(digits, std::to_chars(digits, digits + sizeof(digits), number).ptr);
  return *this;
}

JsonWriter& JsonWriter::unsigned_value(std::uint64_t number) {
  begin_value();
  char digits[24];
  text_.append(digits, std::to_chars(digits, digits + sizeof(digits), number).ptr);
  return *this;
}

JsonWriter& JsonWriter::null() {
  begin_value();
  text_ += "null";
  return *this;
}

JsonWriter& JsonWriter::raw(std::string_view json) {
  begin_value();
  text_ += json;
  return *this;
}

std::string JsonWriter::take() {
  text_ += '\n';
  std::string text = std::move(text_);
  *this = JsonWriter({}, style_);
  return text;
}

JsonWriter& JsonWriter::open(char bracket) {
  begin_value();
  text_ += bracket;
  filled_ <<= 1;
  ++depth_;
  return *this;
}

JsonWriter& JsonWriter::close(char bracket) {
  const bool filled = (filled_ & 1) != 0;
  filled_ >>= 1;
  --depth_;
  if (filled) new_line();
  text_ += bracket;
  return *this;
}

void JsonWriter::begin_value() {
  if (after_key_) {
    after_key_ = false;
    return;
  }
  if (depth_ == 0) return;
  if ((filled_ & 1) != 0) text_ += ',';
  filled_ |= 1;
  new_line();
}

void JsonWriter::new_line() {
  if (style_ == Style::compact) return;
  text_ += '\n';
  text_.append(2 * std::size_t{depth_}, ' ');
}

void JsonWriter::write_text(std::string_view text) {
  constexpr char digits[] = "0123456789abcdef";
  text_ += '"';
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    const char character = text[0];
    if (length == 0) {
      text_ += "\xEF\xBF\xBD";
    } else if (character == '"' || character == '\\') {
      text_ += '\\';
      text_ += character;
    } else if (character == '\n') {
      text_ += "\\n";
    } else if (static_cast<unsigned char>(character) < 0x20 || character == 0x7F) {
      text_ += "\\u00";
      text_ += digits[static_cast<unsigned char>(character) >> 4];
      text_ += digits[static_cast<unsigned char>(character) & 15];
    } else {
      text_.append(text.substr(0, length));
    }
    text.remove_prefix(length == 0 ? 1 : length);
  }
  text_ += '"';
}

}  // namespace flexrf
