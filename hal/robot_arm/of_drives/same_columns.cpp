#include "hal/robot_arm/of_drives/same_columns.hpp"

#include <cstddef>
#include <cstring>

namespace flexrf {
namespace {

std::size_t bytes_of(const FieldDescriptor& field) noexcept {
  switch (field.scalar) {
    case Scalar::i16:
    case Scalar::u16:
      return std::size_t{2} * field.count;
    case Scalar::i32:
    case Scalar::u32:
    case Scalar::f32:
    case Scalar::button:
      return std::size_t{4} * field.count;
    case Scalar::i64:
    case Scalar::u64:
    case Scalar::f64:
      return std::size_t{8} * field.count;
    case Scalar::structure:
      return std::size_t{field.type->size} * field.count;
    default:
      return field.count;
  }
}

bool is_same(const FieldDescriptor& one, const FieldDescriptor& other) noexcept {
  return std::strcmp(one.name, other.name) == 0 && one.scalar == other.scalar && one.type == other.type &&
         one.dimensions == other.dimensions && one.count == other.count;
}

}  // namespace

void copy_same_columns(const TypeDescriptor& from_type, const void* from, const TypeDescriptor& to_type,
                       void* to) noexcept {
  const auto* source = static_cast<const std::byte*>(from);
  auto* target = static_cast<std::byte*>(to);
  for (const FieldDescriptor& have : from_type.fields) {
    for (const FieldDescriptor& want : to_type.fields) {
      if (is_same(have, want)) std::memcpy(target + want.offset, source + have.offset, bytes_of(have));
    }
  }
}

}  // namespace flexrf
