// Fields of plain structs by their descriptors: found by path, checked, read from and written as text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/status.hpp"
#include "runtime/core/parameter_descriptor.hpp"
#include "runtime/core/scalar_types.hpp"
#include "runtime/core/type_descriptor.hpp"

namespace flexrf {

/// A field, or some elements of one, within a struct that may lie several levels above.
struct FieldPlace {
  const FieldDescriptor* field = nullptr;
  std::uint32_t offset = 0;  ///< bytes from the start of the outermost struct
  std::uint32_t count = 0;   ///< elements; bytes of a text
  bool is_element = false;   ///< one element of an array
};

/// What every number of a field must lie in, both ends included.
struct ValueRange {
  double minimum;
  double maximum;
};

FieldPlace whole(const FieldDescriptor& field) noexcept;
/// The parameter's range, or null. `range` is where it is put.
const ValueRange* range_of(const ParameterDescriptor& parameter, ValueRange& range) noexcept;

/// Finds "gain", "gains[2]", "rotation[0][1]" (row, column), "axes[1].limits.low". The cause of a failure
/// names the nearest known name. Any thread; allocates nothing.
Result<FieldPlace> find_field(const TypeDescriptor& type, std::string_view path) noexcept;

/// Whether [offset, offset + size) of a field is whole elements, or whole members of one element.
bool is_whole(const FieldDescriptor& field, std::uint32_t offset, std::uint32_t size) noexcept;

/// Checks what lies at `value`: `count` elements of the field, members of structures likewise. Numbers finite
/// and in range, booleans 0 or 1, enumerations known, texts UTF-8 without control characters (but tab and
/// line feed). The cause begins with the element's or member's path below the field, e.g. "gains[2]: ...".
/// Allocates nothing.
Status check_value(const FieldDescriptor& field, std::uint32_t count, const void* value,
                   const ValueRange* range) noexcept;

/// Checks all parameters of a block; `parameter` becomes the index of the first that fails.
Status check_block(const ParameterBlock& block, const void* values, std::uint16_t& parameter) noexcept;

/// For people and files: numbers shortest that read back the same, elements separated by blanks, rows of a
/// matrix by
/// "; ", enumerations by name, booleans as true and false, texts as they are. Not for structures (ask for
/// their members): empty. Allocates.
std::string text_of(const FieldPlace& place, const void* structure);

/// The reverse: writes the place within `structure` when the whole text is right, else nothing. The cause
/// names value, range, unit of measure, or the nearest name of an enumeration. Allocates nothing for up to
/// 512 bytes of values.
Status write_text(const FieldPlace& place, void* structure, std::string_view text, const ValueRange* range);

/// One number as such; `element` counts from the place's first. not_found for what is no number.
Result<double> read_number(const FieldPlace& place, const void* structure,
                           std::uint32_t element = 0) noexcept;
/// Refuses what the field cannot hold exactly (fractions and too large numbers in integers) or the range
/// forbids.
Status write_number(const FieldPlace& place, void* structure, double number, const ValueRange* range,
                    std::uint32_t element = 0) noexcept;

}  // namespace flexrf
