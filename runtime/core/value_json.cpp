#include "runtime/core/value_json.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "runtime/core/scalar_types.hpp"

namespace flexrf {
namespace {

void write_text(JsonWriter& json, const std::byte* bytes, std::size_t capacity) {
  const auto* text = reinterpret_cast<const char*>(bytes);
  json.value(std::string_view{text, static_cast<std::size_t>(std::find(text, text + capacity, '\0') - text)});
}

void write_enumeration(JsonWriter& json, const TypeDescriptor& type, std::uint8_t number) {
  if (number < type.values.size()) {
    json.value(type.values[number].name);
  } else {
    json.value(number);
  }
}

void write_element(JsonWriter& json, const FieldDescriptor& field, const std::byte* bytes) {
  switch (field.scalar) {
    case Scalar::boolean:
    case Scalar::hold:
      json.value(load<std::uint8_t>(bytes) != 0);
      break;
    case Scalar::button:
      json.value(load<std::uint32_t>(bytes));
      break;
    case Scalar::text:
      write_text(json, bytes, field.count);
      break;
    case Scalar::enumeration:
      write_enumeration(json, *field.type, load<std::uint8_t>(bytes));
      break;
    case Scalar::structure:
      write_value(json, *field.type, bytes);
      break;
    default:
      visit_number(field.scalar, 0, [&](auto tag) {
        json.value(load<decltype(tag)>(bytes));
        return 0;
      });
  }
}

}  // namespace

void write_field(JsonWriter& json, const FieldDescriptor& field, const void* value) {
  const auto* bytes = static_cast<const std::byte*>(value);
  if (field.dimensions == 0 || field.scalar == Scalar::text) return write_element(json, field, bytes);
  const std::size_t size = element_size(field);
  const std::size_t rows = field.shape[0];
  json.begin_array();
  for (std::size_t row = 0; row < rows; ++row) {
    if (field.dimensions == 1) {
      write_element(json, field, bytes + row * size);
      continue;
    }
    json.begin_array();
    for (std::size_t column = 0; column < field.shape[1]; ++column)
      write_element(json, field, bytes + (column * rows + row) * size);
    json.end_array();
  }
  json.end_array();
}

void write_value(JsonWriter& json, const TypeDescriptor& type, const void* value) {
  const auto* bytes = static_cast<const std::byte*>(value);
  json.begin_object();
  for (const FieldDescriptor& field : type.fields) {
    json.key(field.name);
    write_field(json, field, bytes + field.offset);
  }
  json.end_object();
}

}  // namespace flexrf
