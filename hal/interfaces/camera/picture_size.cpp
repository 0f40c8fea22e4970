#include "hal/interfaces/camera/picture_size.hpp"

namespace flexrf {

Status check_picture(std::uint32_t width, std::uint32_t height, PixelFormat format) noexcept {
  const std::uint32_t pixel = bytes_per_pixel(format);
  if (pixel == 0) {
    return Status::error(StatusCode::invalid_argument,
                         "a camera gives yuyv, grey8 or rgb24: set configuration.format to one of them");
  }
  if (width == 0 || height == 0 || (format == PixelFormat::yuyv && width % 2 != 0)) {
    return Status::error(StatusCode::invalid_argument, "there is no picture of %ux%u pixels%s", width, height,
                         width % 2 != 0 ? ": in yuyv the width is even" : "");
  }
  const std::size_t bytes = std::size_t{width} * height * pixel;
  if (bytes > most_picture_bytes) {
    return Status::error(
        StatusCode::out_of_range,
        "a picture of %ux%u pixels takes %zu bytes, an item holds %zu; ask for a smaller one", width, height,
        bytes, most_picture_bytes);
  }
  return {};
}

}  // namespace flexrf
