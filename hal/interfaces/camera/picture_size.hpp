// How many bytes a picture takes, and whether a CameraFrame holds it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <tuple>

#include "runtime/core/status.hpp"
#include "types/camera_frame.hpp"

namespace flexrf {

inline constexpr std::size_t most_picture_bytes = std::tuple_size_v<decltype(CameraFrame::data)>;

/// Bytes that a row's pixels take, at least; 0: there are no rows, or it is none of a camera's formats.
constexpr std::uint32_t row_bytes(PixelFormat format, std::uint32_t width) noexcept {
  switch (format) {
    case PixelFormat::grey8:
    case PixelFormat::nv12:
      return width;
    case PixelFormat::yuyv:
      return width * 2;
    case PixelFormat::rgb24:
      return width * 3;
    case PixelFormat::mjpeg:
    case PixelFormat::none:
    case PixelFormat::bgr24:
      break;
  }
  return 0;
}

/// Rows in the data of a picture: colour may have rows of its own.
constexpr std::uint32_t data_rows(PixelFormat format, std::uint32_t height) noexcept {
  return format == PixelFormat::nv12 ? height + height / 2 : height;
}

/// Of a picture with its rows' padding; 0 of one that has none.
constexpr std::size_t picture_bytes(PixelFormat format, std::uint32_t stride, std::uint32_t height) noexcept {
  return std::size_t{stride} * data_rows(format, height);
}

/// Whether a camera may be asked for this at all. Any thread.
Status check_picture(std::uint32_t width, std::uint32_t height, PixelFormat format) noexcept;

}  // namespace flexrf
