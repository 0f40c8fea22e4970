// Integral images over a camera's picture (Crow 1984; Viola and Jones 2001): what a window holds costs four
// reads, however large it is.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "types/visual_features.hpp"

namespace flexrf::user {

inline constexpr std::uint32_t picture_width = 640;
inline constexpr std::uint32_t picture_height = 480;
inline constexpr std::uint32_t picture_row_bytes = 3 * picture_width;  ///< rgb24
inline constexpr std::uint32_t feature_width = picture_width / 2;
inline constexpr std::uint32_t feature_height = picture_height / 2;
inline constexpr std::uint32_t feature_row = feature_width + 1;  ///< entries from row to row of the sums
static_assert(sizeof(VisualFeatures::luminance) ==
              sizeof(std::uint32_t) * feature_row * (feature_height + 1));

/// Of a whole picture, 0 to 255 each.
struct PictureStatistics {
  double brightness = 0;  ///< mean luminance
  double deviation = 0;   ///< standard deviation of luminance
  double edge = 0;        ///< mean edge strength
};

/// A window of the half-size picture: left and top inclusive, right and bottom exclusive, within the picture.
struct FeatureWindow {
  std::uint32_t left = 0;
  std::uint32_t top = 0;
  std::uint32_t right = 0;
  std::uint32_t bottom = 0;

  double area() const noexcept {
    return static_cast<double>(right - left) * static_cast<double>(bottom - top);
  }
};

/// Sum over a window. Right modulo 2^32, so always but for luminance_squared of windows above 66 051 pixels.
inline std::uint32_t window_sum(const std::array<std::uint32_t, feature_row*(feature_height + 1)>& sums,
                                const FeatureWindow& window) noexcept {
  const std::uint32_t above = window.top * feature_row;
  const std::uint32_t below = window.bottom * feature_row;
  return sums[below + window.right] - sums[below + window.left] - sums[above + window.right] +
         sums[above + window.left];
}

/// Makes the sums of one picture after the other. Of one thread; allocates nothing; the same work for every
/// picture.
class FeatureExtractor {
 public:
  /// The picture before is not one to compare with.
  void forget() noexcept { compares_ = false; }

  /// `pixels`: 480 rows of 640 pixels of rgb24, `stride` bytes from row to row. Fills all of `features` but
  /// frame and time.
  PictureStatistics extract(const std::uint8_t* pixels, std::size_t stride,
                            VisualFeatures& features) noexcept;

  /// Of the last picture: rows of feature_width pixels.
  std::span<const std::uint8_t> luminance() const noexcept { return planes_[current_]; }

 private:
  using Plane = std::array<std::uint8_t, std::size_t{feature_width} * feature_height>;
  using Row = std::array<std::uint16_t, feature_width>;
  using Column = std::array<std::uint32_t, feature_width>;

  void shrink(const std::uint8_t* upper, const std::uint8_t* lower) noexcept;
  void add_colours(std::uint8_t* luminance) noexcept;
  void add_edges(const std::uint8_t* above, const std::uint8_t* here, const std::uint8_t* below) noexcept;
  void add_changes(const std::uint8_t* here, const std::uint8_t* before) noexcept;

  alignas(64) std::array<Plane, 2> planes_{};  // luminance of this picture and the one before
  alignas(64) std::array<std::uint16_t, std::size_t{3} * picture_width> pairs_{};
  alignas(64) Row red_{};
  alignas(64) Row green_{};
  alignas(64) Row blue_{};
  // So far of each column, from the first row on.
  alignas(64) Column luminance_{};
  alignas(64) Column luminance_squared_{};
  alignas(64) Column red_green_{};
  alignas(64) Column yellow_blue_{};
  alignas(64) Column edges_{};
  alignas(64) Column changes_{};
  std::uint32_t current_ = 0;  // of the planes
  bool compares_ = false;
};

}  // namespace flexrf::user
