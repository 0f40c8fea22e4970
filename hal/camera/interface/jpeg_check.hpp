// What shows of a JPEG's damage without decoding it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace flexrf {

struct CheckedJpeg {
  const char* damage = nullptr;  ///< null: none was found; else what is wrong, lives for ever
  std::size_t size = 0;          ///< bytes up to its end, without a camera's padding; 0: damaged
};

/// Follows the markers (ITU-T T.81) from the beginning to the end: that it ends [jpeg-check-1], that its size
/// is the one agreed upon [jpeg-check-2], that no stretch between restart markers is missing [jpeg-check-3].
/// What lies between two markers is not decoded: a picture may pass that a decoder finds garbled. Any thread;
/// never allocates; as quick as looking for a byte.
CheckedJpeg check_jpeg(std::span<const std::uint8_t> bytes, std::uint32_t width,
                       std::uint32_t height) noexcept;

}  // namespace flexrf
