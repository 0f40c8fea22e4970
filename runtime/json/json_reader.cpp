#include "runtime/json/json_reader.hpp"

#include <cstring>
#include <string>

namespace flexrf {
namespace {

using simdjson::dom::element_type;

Status check_names(JsonElement element) noexcept;

Status check_names(JsonObject object) noexcept {
  std::size_t place = 0;
  for (const auto member : object) {
    if (++place > JsonReader::max_members) {
      return Status::error(StatusCode::out_of_range, "an object has more than %zu members",
                           JsonReader::max_members);
    }
    std::size_t before = 0;
    for (const auto other : object) {
      if (++before == place) break;
      if (other.key != member.key) continue;
      return Status::error(StatusCode::invalid_argument, "'%.*s' comes twice in one object",
                           static_cast<int>(std::min<std::size_t>(member.key.size(), 80)), member.key.data());
    }
    if (const Status status = check_names(member.value); !status) return status;
  }
  return {};
}

Status check_names(JsonElement element) noexcept {
  JsonObject object;
  if (element.get(object) == simdjson::SUCCESS) return check_names(object);
  JsonArray array;
  if (element.get(array) != simdjson::SUCCESS) return {};
  for (const JsonElement one : array) {
    // Lists of numbers are long, and hold no names.
    const element_type type = one.type();
    if (type != element_type::OBJECT && type != element_type::ARRAY) continue;
    if (const Status status = check_names(one); !status) return status;
  }
  return {};
}

}  // namespace

JsonReader::JsonReader() {
  // Everything that the parser will ever need is allocated by a text of the greatest size.
  [[maybe_unused]] const auto error = parser_.allocate(max_bytes, max_depth);
  std::memset(padded_, ' ', max_bytes);
  padded_[0] = '{';
  padded_[1] = '}';
  [[maybe_unused]] const auto result = parser_.parse(padded_, max_bytes, false);
}

Result<JsonElement> JsonReader::value(std::string_view text) {
  if (text.size() > max_bytes)
    return Status::error(StatusCode::out_of_range, "more than %zu bytes", max_bytes);
  std::memcpy(padded_, text.data(), text.size());
  std::memset(padded_ + text.size(), 0, simdjson::SIMDJSON_PADDING);
  JsonElement root;
  if (const auto error = parser_.parse(padded_, text.size(), false).get(root); error != simdjson::SUCCESS) {
    return Status::error(
        StatusCode::invalid_argument,
        error == simdjson::DEPTH_ERROR ? "no JSON within %zu levels: %s" : "no JSON (at most %zu levels): %s",
        max_depth, simdjson::error_message(error));
  }
  return root;
}

Result<JsonObject> JsonReader::object(JsonElement value) {
  JsonObject object;
  if (value.get(object) != simdjson::SUCCESS)
    return Status::error(StatusCode::invalid_argument, "it is JSON, but no object {...}");
  if (const Status status = check_names(object); !status) return status;
  return object;
}

Result<JsonObject> JsonReader::object(std::string_view text) {
  const Result<JsonElement> root = value(text);
  if (!root) return root.status();
  return object(*root);
}

bool Fields::has(std::string_view name) const noexcept {
  JsonElement element;
  return object_.at_key(name).get(element) == simdjson::SUCCESS && !element.is_null();
}

template <class Value>
bool Fields::find(std::string_view name, const char* wanted, Value& value) noexcept {
  if (!status_) return false;
  JsonElement element;
  if (object_.at_key(name).get(element) != simdjson::SUCCESS) {
    status_ = Status::error(StatusCode::invalid_argument, "'%.*s' is missing; it is %s",
                            static_cast<int>(name.size()), name.data(), wanted);
    return false;
  }
  if (element.get(value) == simdjson::SUCCESS) return true;
  status_ = Status::error(StatusCode::invalid_argument, "'%.*s' is not %s", static_cast<int>(name.size()),
                          name.data(), wanted);
  return false;
}

std::string_view Fields::text(std::string_view name) noexcept {
  std::string_view value;
  return find(name, "a text", value) ? value : std::string_view{};
}

std::uint64_t Fields::integer(std::string_view name) noexcept {
  std::uint64_t value = 0;
  return find(name, "an integer from 0", value) ? value : 0;
}

double Fields::number(std::string_view name) noexcept {
  double value = 0;
  return find(name, "a number", value) ? value : 0;
}

bool Fields::boolean(std::string_view name) noexcept {
  bool value = false;
  return find(name, "true or false", value) && value;
}

std::optional<JsonObject> Fields::object(std::string_view name) noexcept {
  JsonObject value;
  return find(name, "an object {...}", value) ? std::optional{value} : std::nullopt;
}

std::optional<JsonArray> Fields::array(std::string_view name) noexcept {
  JsonArray value;
  return find(name, "a list [...]", value) ? std::optional{value} : std::nullopt;
}

}  // namespace flexrf
