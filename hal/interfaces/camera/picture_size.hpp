// How many bytes a picture takes, and whether a CameraFrame holds it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <tuple>

#include "runtime/core/status.hpp"
#include "types/camera_frame.hpp"

namespace flexrf {

inline constexpr std::size_t most_picture_bytes = std::tuple_size_v<decltype(CameraFrame::data)>;

/// 0: none of a camera's formats.
constexpr std::uint32_t bytes_per_pixel(PixelFormat format) noexcept {
  switch (format) {
    case PixelFormat::grey8:
      return 1;
    case PixelFormat::yuyv:
      return 2;
    case PixelFormat::rgb24:
      return 3;
    case PixelFormat::none:
    case PixelFormat::bgr24:
      break;
  }
  return 0;
}

/// Whether a camera may be asked for this at all. Any thread.
Status check_picture(std::uint32_t width, std::uint32_t height, PixelFormat format) noexcept;

}  // namespace flexrf
