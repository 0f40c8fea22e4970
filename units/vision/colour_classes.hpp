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

  bool operator==(const WhiteBalance&) const = default;
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

  /// What each value of a channel adds to a colour's place among all colours, by a white balance.
  using Places = std::array<std::array<std::uint16_t, 256>, 3>;
  static void find_places(const WhiteBalance& balance, Places& places) noexcept;

  std::uint8_t of(const std::uint8_t* rgb, const Places& places) const noexcept {
    return classes_[std::size_t{places[0][rgb[0]]} + places[1][rgb[1]] + places[2][rgb[2]]];
  }

  /// Whether pixels are so dark that four of them are too few for is_shadow(): their noise hides the
  /// difference.
  static bool needs_more(const std::array<std::uint32_t, 3>& sums, std::uint32_t count) noexcept {
    return sums[0] + sums[1] + sums[2] < usual_sum * count;
  }

  /// `sums`: of `count` pixels, channel by channel; `count` is 4, or 16 where the pixels are dark.
  bool is_shadow(const std::array<std::uint32_t, 3>& sums, std::uint32_t count,
                 const WhiteBalance& balance) const noexcept {
    // All by the sum, so that nothing is divided.
    const double red = static_cast<double>(sums[0]) * balance.gain[0];
    const double green = static_cast<double>(sums[1]) * balance.gain[1];
    const double blue = static_cast<double>(sums[2]) * balance.gain[2];
    const double sum = red + green + blue;
    if (sum < darkest_shadow_ * count) return false;
    const double off_red = red - table_chromaticity_[0] * sum;
    const double off_green = green - table_chromaticity_[1] * sum;
    const double off_blue = blue - table_chromaticity_[2] * sum;
    const double off = off_red * off_red + off_green * off_green + off_blue * off_blue;
    const double tolerated = like_a_shadow * sum;
    const auto raw = static_cast<double>(sums[0] + sums[1] + sums[2]);
    // The mean of 16 has half of the noise that the mean of 4 has.
    const double usual = usual_sum * count * (count > 4 ? 0.5 : 1.0);
    return raw < usual ? off * raw * raw < tolerated * tolerated * usual * usual
                       : off < tolerated * tolerated;
  }

  /// From what is taken as the table's colour now. False, and `balance` as it was: it is none that light
  /// makes of the table.
  bool balance_of(const Eigen::Vector3d& now, WhiteBalance& balance) const noexcept;

  /// Whether light can make that of the table: by the chromaticity of pixels that were added up.
  bool may_be_table(const std::array<std::uint32_t, 3>& sums) const noexcept;

 private:
  static constexpr double like_a_shadow = 0.020;  // distance of chromaticity, whose channels add up to 1
  // Where the sum of a pixel's channels is less its noise counts for more.
  static constexpr double usual_sum = 150;
  static constexpr std::uint32_t bits = 5;  // of each channel
  static constexpr std::uint32_t levels = 1U << bits;

  std::array<std::uint8_t, std::size_t{levels} * levels * levels> classes_{};
  SurfaceColour table_;
  Eigen::Vector3d table_chromaticity_ = Eigen::Vector3d::Zero();
  double darkest_shadow_ = 0;  // sum of the channels, in 1/256
};

}  // namespace flexrf::user
