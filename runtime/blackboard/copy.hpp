// Copying an item.
#pragma once

#include <cstddef>
#include <cstring>

namespace flexrf {

/// Copies one T. Between these sizes GCC's inline copy (rep movsq) takes up to twice as long as the C
/// library's, which chooses by the processor it runs on: there the size is hidden from the compiler.
template <class T>
inline void copy_item(void* to, const void* from) noexcept {
  std::size_t size = sizeof(T);
  if constexpr (sizeof(T) >= 256 && sizeof(T) < 4096) asm("" : "+r"(size));
  std::memcpy(to, from, size);
}

}  // namespace flexrf
