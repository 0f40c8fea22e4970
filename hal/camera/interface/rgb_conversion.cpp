#include "hal/camera/interface/rgb_conversion.hpp"

#include <algorithm>
#include <cstddef>

namespace flexrf {
namespace {

std::uint8_t as_byte(int value) noexcept {
  return static_cast<std::uint8_t>(std::clamp(value, 0, 255));
}

// Weights in parts of 256.
int brightness_of(const std::uint8_t* rgb) noexcept {
  return (77 * rgb[0] + 150 * rgb[1] + 29 * rgb[2] + 128) >> 8;
}
std::uint8_t blue_of(const std::uint8_t* rgb) noexcept {
  return as_byte(128 + (144 * (rgb[2] - brightness_of(rgb)) + 128) / 256);
}
std::uint8_t red_of(const std::uint8_t* rgb) noexcept {
  return as_byte(128 + (183 * (rgb[0] - brightness_of(rgb)) + 128) / 256);
}

/// Which channel each pixel of two by two has.
struct Mosaic {
  std::size_t channels[4];
};
Mosaic mosaic_of(PixelFormat format) noexcept {
  switch (format) {
    case PixelFormat::bayer_grbg8:
      return {{1, 0, 2, 1}};
    case PixelFormat::bayer_gbrg8:
      return {{1, 2, 0, 1}};
    case PixelFormat::bayer_bggr8:
      return {{2, 1, 1, 0}};
    default:
      return {{0, 1, 1, 2}};
  }
}

}  // namespace

void convert_rgb(std::span<const std::uint8_t> rgb, std::uint32_t width, std::uint32_t height,
                 PixelFormat format, std::span<std::uint8_t> data) noexcept {
  const std::size_t pixels = std::size_t{width} * height;
  const std::uint8_t* from = rgb.data();
  std::uint8_t* to = data.data();
  const auto write_pairs = [&](std::size_t brightness, std::size_t colour) {
    for (std::size_t pixel = 0; pixel < pixels; pixel += 2, from += 6, to += 4) {
      to[brightness] = as_byte(brightness_of(from));
      to[brightness + 2] = as_byte(brightness_of(from + 3));
      to[colour] = blue_of(from);
      to[colour + 2] = red_of(from);
    }
  };
  switch (format) {
    case PixelFormat::rgb24:
      std::copy_n(from, pixels * 3, to);
      return;
    case PixelFormat::yuyv:
      return write_pairs(0, 1);
    case PixelFormat::uyvy:
      return write_pairs(1, 0);
    case PixelFormat::grey16:
      for (std::size_t pixel = 0; pixel < pixels; ++pixel, from += 3) {
        *to++ = 0;
        *to++ = as_byte(brightness_of(from));
      }
      return;
    case PixelFormat::bayer_rggb8:
    case PixelFormat::bayer_grbg8:
    case PixelFormat::bayer_gbrg8:
    case PixelFormat::bayer_bggr8: {
      const Mosaic mosaic = mosaic_of(format);
      for (std::size_t row = 0; row < height; ++row)
        for (std::size_t column = 0; column < width; ++column, from += 3)
          *to++ = from[mosaic.channels[row % 2 * 2 + column % 2]];
      return;
    }
    default:
      break;
  }
  for (std::size_t pixel = 0; pixel < pixels; ++pixel, from += 3) *to++ = as_byte(brightness_of(from));
  if (format != PixelFormat::nv12) return;
  for (std::size_t row = 0; row < height; row += 2) {
    from = &rgb[row * width * 3];
    for (std::size_t column = 0; column < width; column += 2, from += 6) {
      *to++ = blue_of(from);
      *to++ = red_of(from);
    }
  }
}

}  // namespace flexrf
