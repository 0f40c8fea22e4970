// The head of a WebSocket frame as a server sends it.
#pragma once

#include <cstddef>
#include <cstdint>

namespace flexrf::panel {

inline constexpr std::size_t longest_frame_head = 10;

/// Writes it before `payload`, and returns where it begins: one frame is the whole message, unmasked, of so
/// many bytes (RFC 6455, 5.2).
inline char* write_frame_head(char* payload, bool binary, std::size_t size) noexcept {
  const int size_bytes = size < 126 ? 0 : size < 65536 ? 2 : 8;
  for (int i = 0; i < size_bytes; ++i) *--payload = static_cast<char>(size >> (8 * i) & 0xFFU);
  const std::size_t code = size_bytes == 0 ? size : size_bytes == 2 ? 126 : 127;
  *--payload = static_cast<char>(code);
  *--payload = static_cast<char>(binary ? 0x82 : 0x81);
  return payload;
}

}  // namespace flexrf::panel
