#include "units/vision/colour_classes.hpp"

#include <algorithm>
#include <cmath>

namespace flexrf::user {
namespace {

// Distances of chromaticity, whose channels add up to 1.
constexpr double off_the_line = 0.09;    // from table to part: no mixture of the two
constexpr double like_the_table = 0.12;  // light is no more coloured than that
// Part of the table's brightness: what is brighter is the table, whatever dims it.
constexpr double brightest_shadow = 0.7;

Eigen::Vector3d colour_of(SurfaceColour colour) {
  return {static_cast<double>(colour.red), static_cast<double>(colour.green),
          static_cast<double>(colour.blue)};
}

Eigen::Vector3d chromaticity(const Eigen::Vector3d& colour) {
  return colour / std::max(colour.sum(), 1.0);
}

std::uint8_t judge(const Eigen::Vector3d& colour, std::span<const PartModel> parts,
                   const Eigen::Vector3d& table) {
  const Eigen::Vector3d neutral = chromaticity(table);
  const Eigen::Vector3d offset = chromaticity(colour) - neutral;
  double nearest = off_the_line;
  std::size_t kind = parts.size();
  bool is_nearer_to_part = false;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Eigen::Vector3d line = chromaticity(colour_of(parts[i].colour)) - neutral;
    const double along = offset.dot(line) / line.squaredNorm();
    const double off = (offset - std::clamp(along, 0.0, 1.3) * line).norm();
    if (off >= nearest) continue;
    nearest = off;
    kind = i;
    is_nearer_to_part = along >= 0.5;
  }
  if (kind == parts.size()) return class_foreign;
  if (is_nearer_to_part) return static_cast<std::uint8_t>(class_first_part + kind);
  return colour.sum() < brightest_shadow * table.sum() ? class_dark : class_table;
}

}  // namespace

void ColourClasses::prepare(std::span<const PartModel> parts, SurfaceColour table,
                            double darkest_shadow) noexcept {
  table_ = table;
  table_chromaticity_ = chromaticity(colour_of(table));
  darkest_shadow_ = darkest_shadow * colour_of(table).sum() * 256;
  constexpr double width = 256.0 / levels;
  std::size_t place = 0;
  for (std::uint32_t red = 0; red < levels; ++red)
    for (std::uint32_t green = 0; green < levels; ++green)
      for (std::uint32_t blue = 0; blue < levels; ++blue)
        classes_[place++] = judge({(red + 0.5) * width, (green + 0.5) * width, (blue + 0.5) * width}, parts,
                                  colour_of(table));
}

void ColourClasses::find_places(const WhiteBalance& balance, Places& places) noexcept {
  for (std::size_t channel = 0; channel < 3; ++channel) {
    for (std::uint32_t value = 0; value < 256; ++value) {
      const std::uint32_t level = std::min(value * balance.gain[channel] >> (8 + 8 - bits), levels - 1);
      places[channel][value] = static_cast<std::uint16_t>(level << bits * (2 - channel));
    }
  }
}

bool ColourClasses::may_be_table(const std::array<std::uint32_t, 3>& sums) const noexcept {
  return (chromaticity(
              {static_cast<double>(sums[0]), static_cast<double>(sums[1]), static_cast<double>(sums[2])}) -
          table_chromaticity_)
             .squaredNorm() < like_the_table * like_the_table;
}

bool ColourClasses::balance_of(const Eigen::Vector3d& now, WhiteBalance& balance) const noexcept {
  const Eigen::Vector3d known = colour_of(table_);
  // Outside of this there is no light to see by, or too much.
  if (now.minCoeff() < 16 || now.maxCoeff() > 250) return false;
  if ((chromaticity(now) - table_chromaticity_).norm() > like_the_table) return false;
  for (Eigen::Index i = 0; i < 3; ++i)
    balance.gain[static_cast<std::size_t>(i)] =
        static_cast<std::uint32_t>(std::lround(256 * known[i] / now[i]));
  return true;
}

}  // namespace flexrf::user
