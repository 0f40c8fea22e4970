#include "runtime/core/digest.hpp"

#include <cstddef>
#include <cstring>

namespace flexrf {

void Digest::add_bytes(const void* bytes, std::size_t size) noexcept {
  const auto* at = static_cast<const std::byte*>(bytes);
  for (; size >= sizeof(std::uint64_t); size -= sizeof(std::uint64_t), at += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, at, sizeof(word));
    add(word);
  }
  if (size > 0) {
    std::uint64_t word = 0;
    std::memcpy(&word, at, size);
    add(word);
  }
}

void Digest::add_fields(const TypeDescriptor& type, const void* value) noexcept {
  const auto* at = static_cast<const std::byte*>(value);
  for (const ByteRange& range : type.significant) add_bytes(at + range.offset, range.size);
}

}  // namespace flexrf
