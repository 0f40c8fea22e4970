// ColourClasses: what a pixel's colour says it is a picture of, whatever the light.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "units/vision/part_model.hpp"

namespace flexrf::user {

/// Class of a pixel: the table, something foreign, or first_part + kind.
inline constexpr std::uint8_t class_table = 0;
inline constexpr std::uint8_t class_foreign = 1;
inline constexpr std::uint8_t class_first_part = 2;
/// Neutral and darker than the table: a shadow, or something foreign; ColourClasses::is_shadow() tells.
inline constexpr std::uint8_t class_dark = 0xFF;

/// Factors that bring the table's colour under the present light to what it is known to be; in 1/256.
struct WhiteBalance {
  std::array<std::uint32_t, 3> gain{256, 256, 256};
};

/// Colours by their chromaticity (each channel's part of the sum), so that shade changes nothing: a pixel
/// between the table's and a part's, as at a blurred edge, belongs to the nearer one. What is off all lines
/// from the table to a part is foreign. What is dark is a shadow if it is of the table's chromaticity and not
/// too dark; grey that differs from the table by a hair is as dark as one, so that is looked at more closely.
class ColourClasses {
 public:
  /// `darkest_shadow`: part of the table's brightness below which nothing is a shadow. Makes a table of all
  /// colours, which takes some milliseconds; class_dark is one of its answers.
  void prepare(std::span<const PartModel> parts, SurfaceColour table, double darkest_shadow) noexcept;

  std::uint8_t of(const std::uint8_t* rgb, const WhiteBalance& balance) const noexcept {
    const std::uint32_t red = balanced(rgb[0], balance.gain[0]);
    const std::uint32_t green = balanced(rgb[1], balance.gain[1]);
    const std::uint32_t blue = balanced(rgb[2], balance.gain[2]);
    return classes_[(red << 2 * bits) | (green << bits) | blue];
  }

  /// Of `count` pixels that were added up, channel by channel.
  bool is_shadow(const std::array<std::uint32_t, 3>& sums, std::uint32_t count,
                 const WhiteBalance& balance) const noexcept;

  /// From what is taken as the table's colour now. False, and `balance` as it was: it is none that light
  /// makes of the table.
  bool balance_of(const Eigen::Vector3d& now, WhiteBalance& balance) const noexcept;

  /// Whether light can make that of the table: by the chromaticity of pixels that were added up.
  bool may_be_table(const std::array<std::uint32_t, 3>& sums) const noexcept;

 private:
  static constexpr std::uint32_t bits = 5;  // of each channel
  static constexpr std::uint32_t levels = 1U << bits;

  static std::uint32_t balanced(std::uint32_t value, std::uint32_t gain) noexcept {
    const std::uint32_t level = value * gain >> (8 + 8 - bits);
    return level < levels ? level : levels - 1;
  }

  std::array<std::uint8_t, std::size_t{levels} * levels * levels> classes_{};
  SurfaceColour table_;
  Eigen::Vector3d table_chromaticity_ = Eigen::Vector3d::Zero();
  double table_sum_ = 0;
  double darkest_shadow_ = 0;
};

}  // namespace flexrf::user
