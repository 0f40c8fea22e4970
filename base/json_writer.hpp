// Writes JSON text in the order of the calls.
#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace flexrf {

/// RFC 8259, UTF-8; for people a line per member or element, indented by two blanks, for programs without
/// blanks. Bytes that are no UTF-8 become U+FFFD; numbers are the shortest that read back the same; NaN and
/// infinities, which JSON has not, are null. The caller closes what it opened, at most 64 levels, and gives
/// each member of an object its key. Allocates where its text must grow: not for real-time threads.
class JsonWriter {
 public:
  enum class Style : std::uint8_t { indented, compact };

  JsonWriter() = default;
  /// Appends to `text`, whose memory is used first; release() gives it back.
  explicit JsonWriter(std::string text, Style style = Style::compact) noexcept
      : text_(std::move(text)), style_(style) {}

  JsonWriter& begin_object() { return open('{'); }
  JsonWriter& end_object() { return close('}'); }
  JsonWriter& begin_array() { return open('['); }
  JsonWriter& end_array() { return close(']'); }
  JsonWriter& key(std::string_view name);

  JsonWriter& value(std::string_view text);
  JsonWriter& value(const char* text) { return value(std::string_view{text}); }
  JsonWriter& value(bool value);
  JsonWriter& value(double number);
  template <std::signed_integral Integer>
  JsonWriter& value(Integer number) {
    return signed_value(number);
  }
  template <std::unsigned_integral Integer>
  requires(!std::same_as<Integer, bool>) JsonWriter& value(Integer number) { return unsigned_value(number); }
  JsonWriter& null();
  /// A value that is JSON already.
  JsonWriter& raw(std::string_view json);

  template <class Value>
  JsonWriter& member(std::string_view name, const Value& member_value) {
    return key(name).value(member_value);
  }

  /// The text so far, with a line feed at its end; the writer begins anew.
  std::string take();
  /// The text so far as it is; the writer is of no more use.
  std::string release() noexcept { return std::move(text_); }

 private:
  JsonWriter& open(char bracket);
  JsonWriter& close(char bracket);
  JsonWriter& signed_value(std::int64_t number);
  JsonWriter& unsigned_value(std::uint64_t number);
  void begin_value();
  void new_line();
  void write_text(std::string_view text);

  std::string text_;
  std::uint64_t filled_ = 0;  // per open bracket, the innermost lowest: has something in it
  std::uint32_t depth_ = 0;
  Style style_ = Style::indented;
  bool after_key_ = false;
};

}  // namespace flexrf
