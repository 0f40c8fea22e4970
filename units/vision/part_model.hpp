// PartModel: what is known of the parts on the table, as from their drawings.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace flexrf::user {

inline constexpr std::size_t most_corners = 24;
inline constexpr std::size_t outline_stations = 64;
inline constexpr std::size_t most_kinds = 8;
inline constexpr std::uint16_t no_kind = 0xFFFF;  ///< in verdicts and tracks: it is no known part

/// As a camera sees it in white light from straight above; 0 to 255 each.
struct SurfaceColour {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
};

/// Of an outline, from one corner to the next.
struct OutlineSide {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();
  Eigen::Vector2d along = Eigen::Vector2d::Zero();     ///< unit vector
  Eigen::Vector2d outwards = Eigen::Vector2d::Zero();  ///< unit vector
  double length = 0;                                   ///< m
};

/// An upright prism on the table.
struct PartModel {
  const char* name = "";
  std::array<Eigen::Vector2d, most_corners> corners{};  ///< of the outline, counter-clockwise, m
  std::size_t corner_count = 0;
  double height = 0;  ///< m
  SurfaceColour colour;
  int symmetry = 1;  ///< turned by a whole turn over this it looks the same; 0: turned by anything
  // What follows from the outline.
  std::array<OutlineSide, most_corners> sides{};             ///< each begins at the corner of its number
  std::array<Eigen::Vector2d, outline_stations> stations{};  ///< places as far apart along it
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();          ///< centroid, m
  double area = 0;                                           ///< m^2
  double perimeter = 0;                                      ///< m
  double radius = 0;                                         ///< about the outline's origin, m

  std::span<const Eigen::Vector2d> outline() const noexcept { return {corners.data(), corner_count}; }
  std::span<const OutlineSide> all_sides() const noexcept { return {sides.data(), corner_count}; }
};

/// The parts that recognition knows; a kind's number in verdicts and tracks is its place here.
std::span<const PartModel> known_parts() noexcept;

/// Of the table, for white balance.
SurfaceColour known_table_colour() noexcept;

/// The angle that looks the same, nearest to 0: within half a turn over the symmetry.
double within_symmetry(double angle, int symmetry) noexcept;

}  // namespace flexrf::user
