// What the parts on the table look like, and into which bin each belongs: known to everybody, as from the
// drawings of a real cell.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/scene/interface/scene_math.hpp"
#include "types/scene_kind.hpp"

namespace flexrf {

inline constexpr std::size_t most_corners = 24;

/// As a camera sees it in the usual light from straight above.
struct BodyColour {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
};

/// A closed outline, counter-clockwise, in m; it may be concave.
struct Outline {
  std::array<PlaneVector, most_corners> corners{};
  std::size_t count = 0;

  constexpr std::span<const PlaneVector> all() const& noexcept { return {corners.data(), count}; }
  /// A loop over it would outlive what it looks at.
  constexpr std::span<const PlaneVector> all() const&& = delete;
  constexpr void add(PlaneVector corner) noexcept { corners[count++] = corner; }
};

struct PartModel {
  SceneKind kind = SceneKind::none;
  const char* name = "";
  Outline outline;    ///< about its centroid
  double length = 0;  ///< m along x
  double width = 0;   ///< m along y
  double height = 0;  ///< m
  BodyColour colour;
  int symmetry = 1;  ///< turned by a whole turn over this it looks the same; 0: turned by anything
};

/// Directions of 24 corners of a circle, the first along x.
constexpr std::array<PlaneVector, most_corners> circle_directions() noexcept {
  constexpr double sines[] = {
      0, 0.25881904510252076235, 0.5, 0.70710678118654752440, 0.86602540378443864676, 0.96592582628906828675,
      1};
  std::array<PlaneVector, most_corners> directions{};
  for (std::size_t i = 0; i < 6; ++i) {
    const PlaneVector one{sines[6 - i], sines[i]};
    directions[i] = one;
    directions[i + 6] = left_of(one);
    directions[i + 12] = -one;
    directions[i + 18] = -left_of(one);
  }
  return directions;
}

constexpr Outline rectangle(double length, double width) noexcept {
  const double x = length / 2;
  const double y = width / 2;
  Outline outline;
  outline.add({-x, -y});
  outline.add({x, -y});
  outline.add({x, y});
  outline.add({-x, y});
  return outline;
}
constexpr Outline circle(double radius) noexcept {
  Outline outline;
  for (const PlaneVector direction : circle_directions()) outline.add(direction * radius);
  return outline;
}
/// Two of its sides along x.
constexpr Outline regular_hexagon(double across_flats) noexcept {
  constexpr double radius_of_width = 0.57735026918962576451;
  Outline outline;
  for (std::size_t i = 0; i < most_corners; i += 4)
    outline.add(circle_directions()[i] * (across_flats * radius_of_width));
  return outline;
}
/// An L whose arms lie along x and y, so wide, about its centroid.
constexpr Outline angle_bracket(double length, double width, double arm) noexcept {
  const double foot = length * arm;
  const double leg = (width - arm) * arm;
  const double x = (foot * length / 2 + leg * arm / 2) / (foot + leg);
  const double y = (foot * arm / 2 + leg * (width + arm) / 2) / (foot + leg);
  Outline outline;
  outline.add({-x, -y});
  outline.add({length - x, -y});
  outline.add({length - x, arm - y});
  outline.add({arm - x, arm - y});
  outline.add({arm - x, width - y});
  outline.add({-x, width - y});
  return outline;
}

inline constexpr std::size_t part_kinds = 4;
inline constexpr double bracket_arm = 0.018;  // m

inline constexpr std::array<PartModel, part_kinds> part_catalogue{{
    {SceneKind::block, "block", rectangle(0.050, 0.030), 0.050, 0.030, 0.025, {40, 90, 200}, 2},
    {SceneKind::disc, "disc", circle(0.020), 0.040, 0.040, 0.020, {230, 120, 30}, 0},
    {SceneKind::hexagon,
     "hexagon",
     regular_hexagon(0.036),
     0.041569219381653056,
     0.036,
     0.022,
     {50, 160, 70},
     6},
    {SceneKind::bracket,
     "bracket",
     angle_bracket(0.050, 0.040, bracket_arm),
     0.050,
     0.040,
     0.020,
     {220, 190, 40},
     1},
}};

/// Null: it is no part.
constexpr const PartModel* part_model(SceneKind kind) noexcept {
  for (const PartModel& model : part_catalogue)
    if (model.kind == kind) return &model;
  return nullptr;
}

/// Outlined on the table; in m, its sides along x and y.
struct BinModel {
  SceneKind kind = SceneKind::none;  ///< of parts that belong into it
  PlaneVector middle;
  PlaneVector size;
};
inline constexpr std::array<BinModel, part_kinds> part_bins{{
    {SceneKind::block, {0.36, 0.38}, {0.16, 0.12}},
    {SceneKind::disc, {0.54, 0.38}, {0.16, 0.12}},
    {SceneKind::hexagon, {0.36, -0.38}, {0.16, 0.12}},
    {SceneKind::bracket, {0.54, -0.38}, {0.16, 0.12}},
}};

/// Where parts are laid: the middles of all, in m.
inline constexpr PlaneVector parts_area_from{0.30, -0.25};
inline constexpr PlaneVector parts_area_to{0.60, 0.25};

inline constexpr BodyColour table_colour{150, 145, 135};
inline constexpr BodyColour obstacle_colour{70, 70, 75};
inline constexpr BodyColour bin_colour{235, 235, 230};
inline constexpr BodyColour finger_colour{60, 62, 68};

}  // namespace flexrf
