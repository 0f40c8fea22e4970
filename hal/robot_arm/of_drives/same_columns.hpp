#pragma once

#include "runtime/core/type_descriptor.hpp"

namespace flexrf {

/// What one table's configuration says for another's: each value of `from` goes to the one of `to` that has
/// the same name, type and shape. Both are plain structs with these descriptors.
void copy_same_columns(const TypeDescriptor& from_type, const void* from, const TypeDescriptor& to_type,
                       void* to) noexcept;

}  // namespace flexrf
