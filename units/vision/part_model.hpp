// PartModel: what follows from the drawings of the parts on the table.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "base/status.hpp"
#include "types/part_catalogue.hpp"

namespace flexrf::user {

inline constexpr std::size_t most_corners = 24;
inline constexpr std::size_t outline_stations = 64;
inline constexpr std::size_t most_kinds = 8;
inline constexpr std::size_t most_grasps = 24;    ///< of a kind, those that its symmetry makes among them
inline constexpr std::uint16_t no_kind = 0xFFFF;  ///< in verdicts and tracks: it is no known part

/// Of an outline, from one corner to the next.
struct OutlineSide {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();
  Eigen::Vector2d along = Eigen::Vector2d::Zero();     ///< unit vector
  Eigen::Vector2d outwards = Eigen::Vector2d::Zero();  ///< unit vector
  double length = 0;                                   ///< m
};

/// An upright prism on the table.
struct PartModel {
  std::array<char, 25> name{};                          ///< ends with a 0
  std::array<Eigen::Vector2d, most_corners> corners{};  ///< of the outline, counter-clockwise, m
  std::size_t corner_count = 0;
  double height = 0;  ///< m
  SurfaceColour colour{};
  int symmetry = 1;  ///< turned by a whole turn over this it looks the same; 0: turned by anything
  std::array<PartGrasp, most_grasps> grasps{};
  std::size_t grasp_count = 0;
  PartBin bin{};
  // What follows from the outline.
  std::array<OutlineSide, most_corners> sides{};             ///< each begins at the corner of its number
  std::array<Eigen::Vector2d, outline_stations> stations{};  ///< places as far apart along it
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();          ///< centroid, m
  double area = 0;                                           ///< m^2
  double perimeter = 0;                                      ///< m
  double radius = 0;                                         ///< about the outline's origin, m

  std::span<const Eigen::Vector2d> outline() const noexcept { return {corners.data(), corner_count}; }
  std::span<const OutlineSide> all_sides() const noexcept { return {sides.data(), corner_count}; }
  std::span<const PartGrasp> all_grasps() const noexcept { return {grasps.data(), grasp_count}; }
};

/// The parts of a cell. Of one thread; allocates nothing; what all() gives lives as long as this.
class KnownParts {
 public:
  /// Error: there is no part, or a drawing is none that can be; it says which, and why. It is empty then.
  Status take(const PartCatalogue& catalogue) noexcept;

  /// A kind's number in verdicts and tracks is its place here.
  std::span<const PartModel> all() const noexcept { return {models_.data(), count_}; }
  /// Null: there is no such kind.
  const PartModel* find(std::uint16_t kind) const noexcept {
    return kind < count_ ? &models_[kind] : nullptr;
  }

 private:
  std::array<PartModel, most_kinds> models_{};
  std::size_t count_ = 0;
};

/// The angle that looks the same, nearest to 0: within half a turn over the symmetry.
double within_symmetry(double angle, int symmetry) noexcept;

}  // namespace flexrf::user
