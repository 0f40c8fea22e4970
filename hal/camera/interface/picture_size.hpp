// How many bytes a picture takes, and whether there is room for it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/status.hpp"
#include "types/camera_frame.hpp"

namespace flexrf {

/// Of a slot whose row says no other number.
inline constexpr std::size_t usual_picture_bytes = CameraFrame::usual_elements_;

/// Bytes that a row's pixels take, at least; 0: there are no rows, or it is none of a camera's formats.
constexpr std::uint32_t row_bytes(PixelFormat format, std::uint32_t width) noexcept {
  switch (format) {
    case PixelFormat::grey8:
    case PixelFormat::nv12:
    case PixelFormat::bayer_rggb8:
    case PixelFormat::bayer_grbg8:
    case PixelFormat::bayer_gbrg8:
    case PixelFormat::bayer_bggr8:
      return width;
    case PixelFormat::yuyv:
    case PixelFormat::uyvy:
    case PixelFormat::grey16:
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

constexpr bool is_bayer(PixelFormat format) noexcept {
  return format == PixelFormat::bayer_rggb8 || format == PixelFormat::bayer_grbg8 ||
         format == PixelFormat::bayer_gbrg8 || format == PixelFormat::bayer_bggr8;
}

/// All that a camera may be asked for. For messages: "yuyv, uyvy, ...".
inline constexpr PixelFormat camera_formats[] = {
    PixelFormat::yuyv,        PixelFormat::uyvy,        PixelFormat::grey8,       PixelFormat::grey16,
    PixelFormat::rgb24,       PixelFormat::nv12,        PixelFormat::mjpeg,       PixelFormat::bayer_rggb8,
    PixelFormat::bayer_grbg8, PixelFormat::bayer_gbrg8, PixelFormat::bayer_bggr8,
};
inline constexpr const char* camera_formats_text =
    "yuyv, uyvy, grey8, grey16, rgb24, nv12, mjpeg, bayer_rggb8, bayer_grbg8, bayer_gbrg8 or bayer_bggr8";

/// Rows in the data of a picture: colour may have rows of its own.
constexpr std::uint32_t data_rows(PixelFormat format, std::uint32_t height) noexcept {
  return format == PixelFormat::nv12 ? height + height / 2 : height;
}

/// Of a picture with its rows' padding; 0 of one that has none.
constexpr std::size_t picture_bytes(PixelFormat format, std::uint32_t stride, std::uint32_t height) noexcept {
  return std::size_t{stride} * data_rows(format, height);
}

/// Whether a camera may be asked for this at all [picture-size-1]. `room`: bytes that an item of its slot
/// holds; 0: it has no slot, and no limit. Any thread.
Status check_picture(std::uint32_t width, std::uint32_t height, PixelFormat format,
                     std::size_t room) noexcept;

}  // namespace flexrf
