// From a scalar's tag to its C++ type, and how large it is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "runtime/core/type_descriptor.hpp"

namespace flexrf {

/// Calls visit(T{}) with the type that elements of a numeric scalar have, and returns what it returns;
/// `otherwise` for booleans, texts, enumerations, structures, buttons and holds.
template <class Result, class Visit>
Result visit_number(Scalar scalar, Result otherwise, Visit&& visit) {
  switch (scalar) {
    case Scalar::i8:
      return visit(std::int8_t{});
    case Scalar::u8:
      return visit(std::uint8_t{});
    case Scalar::i16:
      return visit(std::int16_t{});
    case Scalar::u16:
      return visit(std::uint16_t{});
    case Scalar::i32:
      return visit(std::int32_t{});
    case Scalar::u32:
      return visit(std::uint32_t{});
    case Scalar::i64:
      return visit(std::int64_t{});
    case Scalar::u64:
      return visit(std::uint64_t{});
    case Scalar::f32:
      return visit(float{});
    case Scalar::f64:
      return visit(double{});
    case Scalar::boolean:
    case Scalar::text:
    case Scalar::enumeration:
    case Scalar::structure:
    case Scalar::button:
    case Scalar::hold:
      break;
  }
  return otherwise;
}

/// Bytes of one element; of a text, 1.
inline std::size_t element_size(const FieldDescriptor& field) noexcept {
  switch (field.scalar) {
    case Scalar::structure:
      return field.type->size;
    case Scalar::button:
      return sizeof(std::uint32_t);
    default:
      return visit_number(field.scalar, std::size_t{1}, [](auto tag) { return sizeof(tag); });
  }
}

/// Bytes of all elements.
inline std::size_t field_size(const FieldDescriptor& field) noexcept {
  return field.count * element_size(field);
}

template <class T>
T load(const void* at) noexcept {
  T value;
  std::memcpy(&value, at, sizeof(value));
  return value;
}

template <class T>
void store(void* at, T value) noexcept {
  std::memcpy(at, &value, sizeof(value));
}

inline const std::byte* bytes_at(const void* structure, std::size_t offset) noexcept {
  return static_cast<const std::byte*>(structure) + offset;
}
inline std::byte* bytes_at(void* structure, std::size_t offset) noexcept {
  return static_cast<std::byte*>(structure) + offset;
}

}  // namespace flexrf
