// JSON that comes from outside: read without allocating, with bounds on size, depth and members.
#pragma once

#include <simdjson.h>

#include <cstdint>
#include <optional>
#include <string_view>

#include "base/status.hpp"

namespace flexrf {

using JsonElement = simdjson::dom::element;
using JsonObject = simdjson::dom::object;
using JsonArray = simdjson::dom::array;

/// One text at a time; what it gave is valid until the next. Any one thread.
class JsonReader {
 public:
  static constexpr std::size_t max_bytes = 16 * 1024;
  static constexpr std::size_t max_depth = 16;
  static constexpr std::size_t max_members = 128;  ///< of one object

  JsonReader();

  /// The text is JSON within the bounds; numbers are finite, and integers fit into 64 bits.
  Result<JsonElement> value(std::string_view text);
  /// It is an object; no name comes twice in it or in any object within.
  static Result<JsonObject> object(JsonElement value);
  /// Both.
  Result<JsonObject> object(std::string_view text);

 private:
  simdjson::dom::parser parser_{max_bytes};
  char padded_[max_bytes + simdjson::SIMDJSON_PADDING] = {};
};

/// Members of one object by name and type. The first that is missing or of another type makes status() say
/// so; what is asked for afterwards is empty.
class Fields {
 public:
  explicit Fields(JsonObject object) noexcept : object_(object) {}

  bool has(std::string_view name) const noexcept;
  std::string_view text(std::string_view name) noexcept;
  std::uint64_t integer(std::string_view name) noexcept;  ///< from 0
  double number(std::string_view name) noexcept;
  bool boolean(std::string_view name) noexcept;
  std::optional<JsonObject> object(std::string_view name) noexcept;
  std::optional<JsonArray> array(std::string_view name) noexcept;

  std::uint64_t integer_or(std::string_view name, std::uint64_t otherwise) noexcept {
    return has(name) ? integer(name) : otherwise;
  }
  double number_or(std::string_view name, double otherwise) noexcept {
    return has(name) ? number(name) : otherwise;
  }
  std::string_view text_or(std::string_view name, std::string_view otherwise) noexcept {
    return has(name) ? text(name) : otherwise;
  }

  const Status& status() const noexcept { return status_; }

 private:
  template <class Value>
  bool find(std::string_view name, const char* wanted, Value& value) noexcept;

  JsonObject object_;
  Status status_;
};

}  // namespace flexrf
