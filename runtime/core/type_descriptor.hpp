// What is known of a data type at run time: enough to show, check, save and digest any value without its C++
// type.
#pragma once

#include <cstdint>
#include <span>

namespace flexrf {

struct TypeDescriptor;

enum class Scalar : std::uint8_t {
  boolean,
  i8,
  u8,
  i16,
  u16,
  i32,
  u32,
  i64,
  u64,
  f32,
  f64,
  text,         ///< characters, zero-terminated unless full; count = capacity in bytes
  enumeration,  ///< stored as u8; FieldDescriptor::type names the values
  structure,    ///< FieldDescriptor::type describes it
  button,       ///< u32: number of presses since the last step (runtime parameters only)
  hold,         ///< bool: true only while its lease lives (runtime parameters only)
};

/// One named field of a plain struct.
struct FieldDescriptor {
  const char* name;
  Scalar scalar;
  std::uint8_t dimensions;  ///< 0: a single value; 1 or 2: an array, two stored column by column
  std::uint32_t shape[2];   ///< extent of each dimension; 0 where unused
  std::uint32_t count;      ///< number of elements (product of the shape), or bytes of a text
  std::uint32_t offset;     ///< bytes from the start of the struct
  const char* unit;         ///< unit of measure, "1" for dimensionless, "" where none applies
  const char* summary;
  const TypeDescriptor* type;  ///< of a structure or an enumeration, else null
};

/// Bytes that carry meaning, between which there is padding.
struct ByteRange {
  std::uint32_t offset;
  std::uint32_t size;
};

/// One value of an enumeration; its number is its place in the list.
struct EnumerationValue {
  const char* name;
  const char* summary;
};

/// A plain struct: trivially copyable, all-zero bytes are a valid value.
struct TypeDescriptor {
  const char* name;
  const char* summary;
  std::uint32_t size;       ///< bytes
  std::uint32_t alignment;  ///< bytes
  std::uint64_t hash;  ///< of name, fields, shapes and units: equal hashes mean the same layout and meaning
  std::span<const FieldDescriptor> fields;
  std::span<const ByteRange> significant;    ///< everything but padding, merged, ascending
  std::span<const EnumerationValue> values;  ///< of an enumeration, else empty
  bool is_image;
  /// Of a type that is as large as its slot says: where the struct has the number of elements (u32) of its
  /// last field, which lies behind it; size and last field are those of one slot. 0: its size is fixed.
  std::uint32_t elements_offset = 0;
};

/// A type that is as large as its slot says (`resizable` in its table). It is looked at where it lies, and
/// cannot be copied by value.
template <class T>
concept SizedBySlot = requires {
  typename T::SlotElement;
};

/// `descriptor_of<Pose>` is the descriptor of Pose; each generated type header specialises it.
template <class T>
extern const TypeDescriptor* const descriptor_of;

}  // namespace flexrf
