// Pictures that are drawn in rgb24, in the other formats of cameras.
#pragma once

#include <cstdint>
#include <span>

#include "types/pixel_format.hpp"

namespace flexrf {

/// Brightness and colour by ITU-R BT.601, full range, in whole numbers; colour that pixels share is that of
/// the first of them. `rgb`: rows without gaps. `data`: as many bytes as a picture without gaps has in
/// `format`, which is none of none, bgr24 and mjpeg; `width` and `height` are even where it shares colour.
/// Any thread.
void convert_rgb(std::span<const std::uint8_t> rgb, std::uint32_t width, std::uint32_t height,
                 PixelFormat format, std::span<std::uint8_t> data) noexcept;

}  // namespace flexrf
