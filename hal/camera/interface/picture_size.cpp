#include "hal/camera/interface/picture_size.hpp"

namespace flexrf {
namespace {

/// What of a picture's size must be even, because pixels share their colour.
const char* must_be_even(std::uint32_t width, std::uint32_t height, PixelFormat format) noexcept {
  if (format == PixelFormat::yuyv && width % 2 != 0) return ": in yuyv the width is even";
  if (format == PixelFormat::uyvy && width % 2 != 0) return ": in uyvy the width is even";
  if (is_bayer(format) && (width % 2 != 0 || height % 2 != 0))
    return ": behind a mosaic of colours width and height are even";
  if (format == PixelFormat::nv12 && (width % 2 != 0 || height % 2 != 0))
    return ": in nv12 width and height are even";
  return "";
}

}  // namespace

Status check_picture(std::uint32_t width, std::uint32_t height, PixelFormat format,
                     std::size_t room) noexcept {
  if (row_bytes(format, 1) == 0 && format != PixelFormat::mjpeg) {
    return Status::error(StatusCode::invalid_argument,
                         "a camera gives %s: set configuration.format to one of them", camera_formats_text);
  }
  const char* const even = must_be_even(width, height, format);
  if (width == 0 || height == 0 || even[0] != '\0') {
    return Status::error(StatusCode::invalid_argument, "there is no picture of %ux%u pixels%s", width, height,
                         even);
  }
  const std::size_t bytes = picture_bytes(format, row_bytes(format, width), height);
  if (room > 0 && bytes > room) {
    return Status::error(StatusCode::out_of_range,
                         "a picture of %ux%u pixels takes %zu bytes, an item of its slot holds %zu: write "
                         "elements = %zu into the row of the slot ([slot.NAME]), or ask for a smaller one",
                         width, height, bytes, room, bytes);
  }
  return {};
}

}  // namespace flexrf
