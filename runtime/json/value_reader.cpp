#include "runtime/json/value_reader.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#include "base/nearest_name.hpp"
#include "runtime/core/scalar_types.hpp"

namespace flexrf {
namespace {

Status wrong(const FieldDescriptor& field, const char* wanted) noexcept {
  return Status::error(StatusCode::invalid_argument, "%s: wants %s", field.name, wanted);
}

/// A number written with a fraction or an exponent, as 1e3, may still be an integer.
template <class Integer>
bool exact(double number, Integer& integer) noexcept {
  constexpr double largest_exact = 9007199254740992.0;
  if (!(std::abs(number) <= largest_exact) || number != std::floor(number)) return false;
  if (number < static_cast<double>(std::numeric_limits<Integer>::lowest()) ||
      number > static_cast<double>(std::numeric_limits<Integer>::max()))
    return false;
  integer = static_cast<Integer>(number);
  return true;
}

template <class Integer>
bool read_integer(JsonElement json, Integer& integer) noexcept {
  std::int64_t signed_number = 0;
  std::uint64_t unsigned_number = 0;
  double real = 0;
  if (json.is<double>() && json.type() == simdjson::dom::element_type::DOUBLE)
    return json.get(real) == simdjson::SUCCESS && exact(real, integer);
  if (json.get(signed_number) == simdjson::SUCCESS) {
    integer = static_cast<Integer>(signed_number);
    return std::in_range<Integer>(signed_number);
  }
  if (json.get(unsigned_number) != simdjson::SUCCESS) return false;
  integer = static_cast<Integer>(unsigned_number);
  return std::in_range<Integer>(unsigned_number);
}

template <class Number>
Status read_number_of(JsonElement json, const FieldDescriptor& field, std::byte* at) noexcept {
  if constexpr (std::is_floating_point_v<Number>) {
    double number = 0;
    if (json.get(number) != simdjson::SUCCESS) return wrong(field, "a number");
    store(at, static_cast<Number>(number));
  } else {
    Number number = 0;
    if (!json.is_number()) return wrong(field, "an integer");
    if (!read_integer(json, number)) {
      return Status::error(StatusCode::out_of_range, "%s: wants an integer from %lld to %llu", field.name,
                           static_cast<long long>(std::numeric_limits<Number>::lowest()),
                           static_cast<unsigned long long>(std::numeric_limits<Number>::max()));
    }
    store(at, number);
  }
  return {};
}

Status read_enumeration(JsonElement json, const FieldDescriptor& field, std::byte* at) noexcept {
  std::string_view name;
  if (json.get(name) != simdjson::SUCCESS) return wrong(field, "the name of a value, as text");
  NearestName nearest(name);
  const auto& values = field.type->values;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (name == values[i].name) {
      store(at, static_cast<std::uint8_t>(i));
      return {};
    }
    nearest.offer(values[i].name);
  }
  const std::string_view best = nearest.best().empty() ? values[0].name : nearest.best();
  return Status::error(StatusCode::not_found, "%s: %s has no value '%.*s'; did you mean '%.*s'?", field.name,
                       field.type->name, static_cast<int>(std::min<std::size_t>(name.size(), 60)),
                       name.data(), static_cast<int>(best.size()), best.data());
}

Status read_text(JsonElement json, const FieldDescriptor& field, std::byte* at) noexcept {
  std::string_view text;
  if (json.get(text) != simdjson::SUCCESS) return wrong(field, "a text");
  if (text.size() > field.count) {
    return Status::error(StatusCode::out_of_range, "%s: a text of %zu bytes, at most %u fit", field.name,
                         text.size(), field.count);
  }
  if (text.find('\0') != std::string_view::npos)
    return Status::error(StatusCode::invalid_argument, "%s: character 0 in the text", field.name);
  std::memset(at, 0, field.count);
  std::memcpy(at, text.data(), text.size());
  return {};
}

Status read_field(JsonElement json, const FieldDescriptor& field, std::byte* at) noexcept;

Status read_structure(JsonElement json, const FieldDescriptor& field, std::byte* at) noexcept {
  JsonObject object;
  if (json.get(object) != simdjson::SUCCESS) return wrong(field, "an object with all members");
  const TypeDescriptor& type = *field.type;
  for (const auto member : object) {
    if (const Result<FieldPlace> known = find_field(type, member.key); !known) return known.status();
  }
  for (const FieldDescriptor& member : type.fields) {
    JsonElement value;
    if (object.at_key(member.name).get(value) != simdjson::SUCCESS) {
      return Status::error(StatusCode::invalid_argument,
                           "%s: the member '%s' is missing; write all, or '%s.%s'", field.name, member.name,
                           field.name, member.name);
    }
    if (const Status status = read_field(value, member, at + member.offset); !status) return status;
  }
  return {};
}

Status read_element(JsonElement json, const FieldDescriptor& field, std::byte* at) noexcept {
  switch (field.scalar) {
    case Scalar::boolean: {
      bool on = false;
      if (json.get(on) != simdjson::SUCCESS) return wrong(field, "true or false");
      store(at, static_cast<std::uint8_t>(on));
      return {};
    }
    case Scalar::enumeration:
      return read_enumeration(json, field, at);
    case Scalar::structure:
      return read_structure(json, field, at);
    case Scalar::button:
      return wrong(field, "to be pressed, not set");
    case Scalar::hold:
      return wrong(field, "to be held, not set");
    default:
      return visit_number(field.scalar, wrong(field, "no such value"),
                          [&](auto tag) { return read_number_of<decltype(tag)>(json, field, at); });
  }
}

Status read_list(JsonElement json, const FieldDescriptor& field, std::byte* at) noexcept {
  const std::size_t one = element_size(field);
  const std::uint32_t rows = field.shape[0];
  JsonArray list;
  if (json.get(list) != simdjson::SUCCESS || list.size() != rows) {
    return Status::error(StatusCode::invalid_argument, "%s: wants a list of %u%s", field.name, rows,
                         field.dimensions == 2 ? " rows" : "");
  }
  std::uint32_t row = 0;
  for (const JsonElement element : list) {
    if (field.dimensions == 1) {
      if (const Status status = read_element(element, field, at + row * one); !status) return status;
    } else {
      JsonArray columns;
      if (element.get(columns) != simdjson::SUCCESS || columns.size() != field.shape[1]) {
        return Status::error(StatusCode::invalid_argument, "%s: row %u wants a list of %u", field.name, row,
                             field.shape[1]);
      }
      std::size_t column = 0;
      for (const JsonElement value : columns) {
        const Status status = read_element(value, field, at + (column++ * rows + row) * one);
        if (!status) return status;
      }
    }
    ++row;
  }
  return {};
}

Status read_field(JsonElement json, const FieldDescriptor& field, std::byte* at) noexcept {
  if (field.scalar == Scalar::text) return read_text(json, field, at);
  return field.dimensions > 0 ? read_list(json, field, at) : read_element(json, field, at);
}

}  // namespace

Status read_value(JsonElement json, const FieldPlace& place, void* structure,
                  const ValueRange* range) noexcept {
  std::byte* const at = bytes_at(structure, place.offset);
  const Status status =
      place.is_element ? read_element(json, *place.field, at) : read_field(json, *place.field, at);
  if (!status) return status;
  return check_value(*place.field, place.count, at, range);
}

}  // namespace flexrf
