// Types for the blackboard's tests, described by hand as config-gen would.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

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

/// As large as its slot says, and otherwise of eight numbers.
struct Cloud {
  std::uint32_t count{};
  std::uint32_t elements_{};

  using SlotElement = std::uint64_t;
  static constexpr std::size_t elements_begin_ = 4096;
  static constexpr std::size_t usual_elements_ = 8;
  std::span<std::uint64_t> points() noexcept {
    return {reinterpret_cast<std::uint64_t*>(reinterpret_cast<std::byte*>(this) + elements_begin_),
            elements_};
  }

  Cloud() noexcept = default;

 private:
  Cloud(const Cloud&) = default;
  Cloud& operator=(const Cloud&) = default;
};

inline constexpr FieldDescriptor cloud_fields[] = {
    {"count", Scalar::u32, 0, {}, 1, 0, "1", "A number.", nullptr},
    {"points", Scalar::u64, 1, {8, 0}, 8, 4096, "1", "Numbers.", nullptr},
};
inline constexpr ByteRange cloud_significant[] = {{0, 4}, {4096, 64}};
inline constexpr TypeDescriptor cloud_type = {"Cloud",      "For tests.",      4160, alignof(Cloud), 0x5B,
                                              cloud_fields, cloud_significant, {},   false,          4};

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
template <>
inline constexpr const TypeDescriptor* descriptor_of<test::Cloud> = &test::cloud_type;
template <std::size_t Words>
inline constexpr const TypeDescriptor* descriptor_of<test::Block<Words>> = &test::block_type<Words>;

}  // namespace flexrf
