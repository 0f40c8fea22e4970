// How sharply a picture shows edges: a lens out of focus, or one with a film of oil on it, makes all of them
// wide.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace flexrf::user {

/// Of a strong edge the part of its contrast that lies within two pixels: 1 is a step, 0.68, 0.38 and 0.20 a
/// step that is blurred by a Gaussian of 1, 2 and 4 pixels. Told is that of the sharpest tenth of the edges
/// along rows and columns, as motion blurs only those across its way. No value: there are too few to tell.
/// `luminance`: rows of `width` pixels, one behind the other. Any thread; allocates nothing.
std::optional<double> edge_sharpness(std::span<const std::uint8_t> luminance, std::size_t width) noexcept;

}  // namespace flexrf::user
