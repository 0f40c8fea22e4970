#include "units/vision/table_light.hpp"

#include <algorithm>

namespace flexrf::user {
namespace {

// Squares of 2 x 2 pixels, whose mean has half of the noise.
constexpr int sample_columns = 53;
constexpr int sample_rows = 40;
constexpr std::uint32_t level_width = 12;  // of brightness, sum of 12 values, to a level
constexpr double same_brightness =
    0.12;  // of brightness: the table's grain and noise, and less than to a shadow
constexpr double least_of_a_picture = 0.08;  // of what was looked at: what is less may be a bin's outline
// A table that became darker than this may be a shadow or an obstacle, unless it is most of the picture.
constexpr double may_be_a_shadow = 0.85;
constexpr double most_of_a_picture = 0.5;
// Least part of a picture that has to be grey: coloured light may make a few obstacles as grey as the table.
constexpr double least_grey = 0.25;

}  // namespace

bool TableLight::look(const PictureView& picture, const PixelRectangle& blind,
                      const ColourClasses& classes) noexcept {
  histogram_.fill({});
  std::uint32_t looked = 0;
  std::uint32_t grey = 0;
  for (int i = 0; i < sample_rows; ++i) {
    const int row = (2 * i + 1) * (picture.height - 1) / (2 * sample_rows);
    for (int k = 0; k < sample_columns; ++k) {
      const int column = (2 * k + 1) * (picture.width - 1) / (2 * sample_columns);
      if (blind.holds(column, row)) continue;
      ++looked;
      const std::uint8_t* const above = picture.at(column, row);
      const std::uint8_t* const below = picture.at(column, row + 1);
      std::array<std::uint32_t, 3> sums{};
      for (std::size_t c = 0; c < 3; ++c)
        sums[c] = std::uint32_t{above[c]} + above[c + 3] + below[c] + below[c + 3];
      if (!classes.may_be_table(sums)) continue;
      ++grey;
      Level& level = histogram_[std::min((sums[0] + sums[1] + sums[2]) / level_width, levels - 1)];
      ++level.count;
      for (std::size_t c = 0; c < 3; ++c) level.sums[c] += sums[c];
    }
  }
  sees_no_grey_ = grey < least_grey * looked;
  const auto least = static_cast<std::uint32_t>(least_of_a_picture * looked) + 1;
  const std::uint32_t table = brightest(least);
  if (table == levels) return false;
  const std::uint32_t count = around(table);
  if (table * level_width / 4.0 < may_be_a_shadow * brightness_ && count < most_of_a_picture * looked)
    return false;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  const auto first = static_cast<std::uint32_t>((1 - same_brightness) * table);
  const auto last = std::min(static_cast<std::uint32_t>((1 + same_brightness) * table) + 1, levels - 1);
  for (std::uint32_t level = first; level <= last; ++level)
    for (std::size_t c = 0; c < 3; ++c) mean[static_cast<Eigen::Index>(c)] += histogram_[level].sums[c];
  mean /= 4.0 * count;
  if (!classes.balance_of(mean, balance_)) return false;
  brightness_ = mean.sum();
  return true;
}

/// How much is as bright as this level, about.
std::uint32_t TableLight::around(std::uint32_t level) const noexcept {
  const auto first = static_cast<std::uint32_t>((1 - same_brightness) * level);
  const auto last = std::min(static_cast<std::uint32_t>((1 + same_brightness) * level) + 1, levels - 1);
  std::uint32_t count = 0;
  for (std::uint32_t i = first; i <= last; ++i) count += histogram_[i].count;
  return count;
}

/// The level of the brightest that is not rare; `levels`: there is none.
std::uint32_t TableLight::brightest(std::uint32_t least) const noexcept {
  for (std::uint32_t level = levels; level-- > 0;) {
    std::uint32_t count = around(level);
    if (count < least) continue;
    // Down to where there is most of it.
    while (level > 0) {
      const std::uint32_t below = around(level - 1);
      if (below < count) break;
      count = below;
      --level;
    }
    return level;
  }
  return levels;
}

}  // namespace flexrf::user
