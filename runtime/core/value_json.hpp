// Any described value as JSON.
#pragma once

#include "base/json_writer.hpp"
#include "runtime/core/type_descriptor.hpp"

namespace flexrf {

/// Writes the plain struct at `value` as an object: arrays as lists, matrices as lists of rows, enumerations
/// by name (a number that is none of its values as a number), texts without what follows their zero.
/// Allocates.
void write_value(JsonWriter& json, const TypeDescriptor& type, const void* value);
/// The same of one field, which begins at `value`.
void write_field(JsonWriter& json, const FieldDescriptor& field, const void* value);

}  // namespace flexrf
