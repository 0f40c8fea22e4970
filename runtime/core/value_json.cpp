#include "runtime/core/value_json.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string_view>

namespace flexrf {
namespace {

template <class Value>
Value at(const std::byte* bytes) noexcept {
  Value value;
  std::memcpy(&value, bytes, sizeof(value));
  return value;
}

std::size_t size_of_element(const FieldDescriptor& field) noexcept {
  switch (field.scalar) {
    case Scalar::boolean:
    case Scalar::hold:
    case Scalar::i8:
    case Scalar::u8:
    case Scalar::enumeration:
    case Scalar::text:
      return 1;
    case Scalar::i16:
    case Scalar::u16:
      return 2;
    case Scalar::i32:
    case Scalar::u32:
    case Scalar::f32:
    case Scalar::button:
      return 4;
    case Scalar::i64:
    case Scalar::u64:
    case Scalar::f64:
      return 8;
    case Scalar::structure:
      return field.type->size;
  }
  return 0;
}

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
      json.value(at<std::uint8_t>(bytes) != 0);
      break;
    case Scalar::i8:
      json.value(at<std::int8_t>(bytes));
      break;
    case Scalar::u8:
      json.value(at<std::uint8_t>(bytes));
      break;
    case Scalar::i16:
      json.value(at<std::int16_t>(bytes));
      break;
    case Scalar::u16:
      json.value(at<std::uint16_t>(bytes));
      break;
    case Scalar::i32:
      json.value(at<std::int32_t>(bytes));
      break;
    case Scalar::u32:
    case Scalar::button:
      json.value(at<std::uint32_t>(bytes));
      break;
    case Scalar::i64:
      json.value(at<std::int64_t>(bytes));
      break;
    case Scalar::u64:
      json.value(at<std::uint64_t>(bytes));
      break;
    case Scalar::f32:
      json.value(static_cast<double>(at<float>(bytes)));
      break;
    case Scalar::f64:
      json.value(at<double>(bytes));
      break;
    case Scalar::text:
      write_text(json, bytes, field.count);
      break;
    case Scalar::enumeration:
      write_enumeration(json, *field.type, at<std::uint8_t>(bytes));
      break;
    case Scalar::structure:
      write_value(json, *field.type, bytes);
      break;
  }
}

}  // namespace

void write_field(JsonWriter& json, const FieldDescriptor& field, const void* value) {
  const auto* bytes = static_cast<const std::byte*>(value);
  if (field.dimensions == 0 || field.scalar == Scalar::text) return write_element(json, field, bytes);
  const std::size_t size = size_of_element(field);
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
