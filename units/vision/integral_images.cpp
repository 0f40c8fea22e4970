// The loops have fixed counts and know that their arrays do not overlap, so that the compiler makes vector
// instructions of them with the options of a release. What remains one by one are sums along a row.
#include "units/vision/integral_images.hpp"

#include <algorithm>
#include <cmath>

namespace flexrf::user {
namespace {

using Sums = std::array<std::uint32_t, feature_row*(feature_height + 1)>;

/// Entries of the row below `row`, from the columns' sums down to it; three images at once, as each waits for
/// its own last sum.
void sum_along(const std::uint32_t* __restrict one, const std::uint32_t* __restrict two,
               const std::uint32_t* __restrict three, std::uint32_t* __restrict to_one,
               std::uint32_t* __restrict to_two, std::uint32_t* __restrict to_three) noexcept {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  std::uint32_t c = 0;
  to_one[0] = to_two[0] = to_three[0] = 0;
  for (std::uint32_t x = 0; x < feature_width; ++x) {
    to_one[x + 1] = a += one[x];
    to_two[x + 1] = b += two[x];
    to_three[x + 1] = c += three[x];
  }
}

std::uint32_t* row_of(Sums& sums, std::uint32_t row) noexcept {
  return sums.data() + std::size_t{row} * feature_row;
}

}  // namespace

/// Two rows of the picture to one of half as many pixels.
void FeatureExtractor::shrink(const std::uint8_t* __restrict upper,
                              const std::uint8_t* __restrict lower) noexcept {
  std::uint16_t* __restrict pairs = pairs_.data();
  for (std::uint32_t i = 0; i < picture_row_bytes; ++i)
    pairs[i] = static_cast<std::uint16_t>(upper[i] + lower[i]);
  for (std::uint32_t x = 0; x < feature_width; ++x) {
    const std::uint16_t* const pair = pairs_.data() + std::size_t{6} * x;
    red_[x] = static_cast<std::uint16_t>((pair[0] + pair[3] + 2) >> 2);
    green_[x] = static_cast<std::uint16_t>((pair[1] + pair[4] + 2) >> 2);
    blue_[x] = static_cast<std::uint16_t>((pair[2] + pair[5] + 2) >> 2);
  }
}

/// Luminance by BT.601; opponent colours as red - green and (red + green) / 2 - blue, moved to 0 to 255.
void FeatureExtractor::add_colours(std::uint8_t* __restrict luminance) noexcept {
  const std::uint16_t* __restrict red = red_.data();
  const std::uint16_t* __restrict green = green_.data();
  const std::uint16_t* __restrict blue = blue_.data();
  std::uint32_t* __restrict sum = luminance_.data();
  std::uint32_t* __restrict squared = luminance_squared_.data();
  std::uint32_t* __restrict red_green = red_green_.data();
  std::uint32_t* __restrict yellow_blue = yellow_blue_.data();
  for (std::uint32_t x = 0; x < feature_width; ++x) {
    const auto y = static_cast<std::uint16_t>(
        static_cast<std::uint16_t>(77 * red[x] + 150 * green[x] + 29 * blue[x]) >> 8);
    luminance[x] = static_cast<std::uint8_t>(y);
    sum[x] += y;
    squared[x] += static_cast<std::uint16_t>(y * y);
    red_green[x] += static_cast<std::uint16_t>(static_cast<std::uint16_t>(red[x] + 255 - green[x]) >> 1);
    yellow_blue[x] +=
        static_cast<std::uint16_t>(static_cast<std::uint16_t>(red[x] + green[x] + 510 - 2 * blue[x]) >> 2);
  }
}

/// The first and last column have none: they count as 0.
void FeatureExtractor::add_edges(const std::uint8_t* __restrict above, const std::uint8_t* __restrict here,
                                 const std::uint8_t* __restrict below) noexcept {
  std::uint32_t* __restrict sum = edges_.data();
  const auto strength = [&](std::uint32_t x) {
    const int across = here[x + 1] - here[x - 1];
    const int down = below[x] - above[x];
    return static_cast<std::uint32_t>((std::abs(across) + std::abs(down)) >> 1);
  };
  // A multiple of what a vector holds, and the rest by itself.
  constexpr std::uint32_t together = (feature_width - 2) / 16 * 16;
  for (std::uint32_t x = 0; x < together; ++x) sum[x + 1] += strength(x + 1);
  for (std::uint32_t x = together + 1; x < feature_width - 1; ++x) sum[x] += strength(x);
}

void FeatureExtractor::add_changes(const std::uint8_t* __restrict here,
                                   const std::uint8_t* __restrict before) noexcept {
  std::uint32_t* __restrict sum = changes_.data();
  for (std::uint32_t x = 0; x < feature_width; ++x)
    sum[x] += static_cast<std::uint32_t>(std::abs(here[x] - before[x]));
}

PictureStatistics FeatureExtractor::extract(const std::uint8_t* pixels, std::size_t stride,
                                            VisualFeatures& features) noexcept {
  current_ ^= 1;
  Plane& plane = planes_[current_];
  const Plane& before = planes_[current_ ^ 1];
  for (Column* column : {&luminance_, &luminance_squared_, &red_green_, &yellow_blue_, &edges_, &changes_})
    column->fill(0);
  for (Sums* sums : {&features.luminance, &features.luminance_squared, &features.red_green,
                     &features.yellow_blue, &features.edges, &features.changes})
    std::fill_n(sums->data(), feature_row, 0U);

  for (std::uint32_t y = 0; y < feature_height; ++y) {
    const std::uint8_t* const upper = pixels + std::size_t{2} * y * stride;
    shrink(upper, upper + stride);
    std::uint8_t* const here = plane.data() + std::size_t{y} * feature_width;
    add_colours(here);
    sum_along(luminance_.data(), luminance_squared_.data(), red_green_.data(),
              row_of(features.luminance, y + 1), row_of(features.luminance_squared, y + 1),
              row_of(features.red_green, y + 1));
    if (compares_) add_changes(here, before.data() + std::size_t{y} * feature_width);
    // Edges need the row below, so they are a row behind; the first row and the last have none.
    if (y >= 2) add_edges(here - 2 * feature_width, here - feature_width, here);
    sum_along(yellow_blue_.data(), changes_.data(), edges_.data(), row_of(features.yellow_blue, y + 1),
              row_of(features.changes, y + 1), row_of(features.edges, y));
  }
  std::copy_n(row_of(features.edges, feature_height - 1), feature_row,
              row_of(features.edges, feature_height));

  std::uint64_t squares = 0;
  for (const std::uint32_t square : luminance_squared_) squares += square;
  constexpr double pixels_in_all = static_cast<double>(feature_width) * feature_height;
  PictureStatistics of{};
  of.brightness = features.luminance.back() / pixels_in_all;
  const double variance = static_cast<double>(squares) / pixels_in_all - of.brightness * of.brightness;
  of.deviation = std::sqrt(std::max(variance, 0.0));
  of.edge = features.edges.back() / pixels_in_all;
  features.brightness = static_cast<float>(of.brightness);
  features.compares = compares_;
  compares_ = true;
  return of;
}

}  // namespace flexrf::user
