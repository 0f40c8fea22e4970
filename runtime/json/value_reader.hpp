// A value from JSON into a field of a plain struct.
#pragma once

#include "runtime/json/json_reader.hpp"
#include "runtime/parameters/value_access.hpp"

namespace flexrf {

/// Writes the place within `structure`, whole: an array wants a list of as many elements, a matrix a list of
/// its rows, a structure an object with all its members. Checked as check_value() does; the cause names the
/// element. What lies there is unspecified after a failure. Allocates nothing.
Status read_value(JsonElement json, const FieldPlace& place, void* structure,
                  const ValueRange* range) noexcept;

}  // namespace flexrf
