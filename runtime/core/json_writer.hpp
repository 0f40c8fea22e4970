// Writes JSON text in the order of the calls.
#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace flexrf {

/// RFC 8259, UTF-8, a line per member or element, indented by two blanks. Bytes that are no UTF-8 become
/// U+FFFD; numbers are the shortest that read back the same; NaN and infinities, which JSON has not, are
/// null. The caller closes what it opened, and gives each member of an object its key. Allocates: not for
/// real-time threads.
class JsonWriter {
 public:
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

  template <class Value>
  JsonWriter& member(std::string_view name, const Value& member_value) {
    return key(name).value(member_value);
  }

  /// The text so far, with a line feed at its end; the writer begins anew.
  std::string take();

 private:
  JsonWriter& open(char bracket);
  JsonWriter& close(char bracket);
  JsonWriter& signed_value(std::int64_t number);
  JsonWriter& unsigned_value(std::uint64_t number);
  void begin_value();
  void new_line();
  void write_text(std::string_view text);

  std::string text_;
  std::vector<bool> filled_;  // per open bracket: has something in it
  bool after_key_ = false;
};

}  // namespace flexrf
