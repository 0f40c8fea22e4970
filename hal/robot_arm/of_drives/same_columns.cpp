#include "hal/robot_arm/of_drives/same_columns.hpp"

#include <cstddef>
#include <cstring>

#include "runtime/core/scalar_types.hpp"

namespace flexrf {
namespace {

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
      if (is_same(have, want)) std::memcpy(target + want.offset, source + have.offset, field_size(have));
    }
  }
}

}  // namespace flexrf
