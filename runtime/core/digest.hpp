// A running 64-bit digest of what an application did: the same run gives the same digest.
#pragma once

#include <cstdint>
#include <string_view>

#include "runtime/core/type_descriptor.hpp"

namespace flexrf {

/// Not cryptographic: it tells runs apart, it does not resist an adversary.
class Digest {
 public:
  constexpr Digest() noexcept = default;
  constexpr explicit Digest(std::uint64_t so_far) noexcept : state_(so_far) {}

  /// The finaliser of SplitMix64 (Steele, Lea, Flood 2014) over state and word: order matters, every bit
  /// spreads.
  constexpr void add(std::uint64_t word) noexcept {
    std::uint64_t mixed = (state_ ^ word) + 0x9E3779B97F4A7C15U;
    mixed = (mixed ^ (mixed >> 30)) * 0xBF58476D1CE4E5B9U;
    mixed = (mixed ^ (mixed >> 27)) * 0x94D049BB133111EBU;
    state_ = mixed ^ (mixed >> 31);
  }
  void add_bytes(const void* bytes, std::size_t size) noexcept;
  void add_text(std::string_view text) noexcept { add(text.size()), add_bytes(text.data(), text.size()); }
  /// The value's fields without the padding between them.
  void add_fields(const TypeDescriptor& type, const void* value) noexcept;

  constexpr std::uint64_t value() const noexcept { return state_; }

 private:
  std::uint64_t state_ = 0;
};

}  // namespace flexrf
