// Types for the blackboard's tests, described by hand as config-gen would.
#pragma once

#include <cstdint>

#include "runtime/core/type_descriptor.hpp"

namespace flexrf::test {

/// Has padding, which must not count.
struct Sample {
  std::uint32_t number;
  double value;
  std::uint8_t flag;
};

inline constexpr FieldDescriptor sample_fields[] = {
    {"number", Scalar::u32, 0, {}, 1, offsetof(Sample, number), "1", "A number.", nullptr},
    {"value", Scalar::f64, 0, {}, 1, offsetof(Sample, value), "m", "A value.", nullptr},
    {"flag", Scalar::u8, 0, {}, 1, offsetof(Sample, flag), "1", "A flag.", nullptr},
};
inline constexpr ByteRange sample_significant[] = {{0, 4}, {offsetof(Sample, value), 9}};
inline constexpr TypeDescriptor sample_type = {"Sample",           "For tests.", sizeof(Sample),
                                               alignof(Sample),    0x5A,         sample_fields,
                                               sample_significant, {},           false};

/// Every word says which item it belongs to, so that a torn one shows.
template <std::size_t Words>
struct Block {
  std::uint64_t words[Words];

  void fill(std::uint64_t with) noexcept {
    for (std::uint64_t& word : words) word = with;
  }
  bool is_whole() const noexcept {
    for (const std::uint64_t& word : words) {
      if (word != words[0]) return false;
    }
    return true;
  }
};

template <std::size_t Words>
inline constexpr ByteRange block_significant[] = {{0, Words * 8}};
template <std::size_t Words>
inline constexpr TypeDescriptor block_type = {
    "Block", "For tests.", Words * 8, 8, 0xB0 + Words, {}, block_significant<Words>, {}, false};

}  // namespace flexrf::test

namespace flexrf {

template <>
inline constexpr const TypeDescriptor* descriptor_of<test::Sample> = &test::sample_type;
template <std::size_t Words>
inline constexpr const TypeDescriptor* descriptor_of<test::Block<Words>> = &test::block_type<Words>;

}  // namespace flexrf
