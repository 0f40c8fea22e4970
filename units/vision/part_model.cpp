#include "units/vision/part_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flexrf::user {
namespace {

constexpr double pi = std::numbers::pi;
constexpr std::size_t kinds = 4;

/// What follows from the outline.
PartModel complete(PartModel part) {
  double twice = 0;
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < part.corner_count; ++i) {
    const Eigen::Vector2d& from = part.corners[i];
    const Eigen::Vector2d& to = part.corners[(i + 1) % part.corner_count];
    const double cross = from.x() * to.y() - from.y() * to.x();
    twice += cross;
    moment += (from + to) * cross;
    part.perimeter += (to - from).norm();
    part.radius = std::max(part.radius, from.norm());
  }
  part.area = twice / 2;
  part.middle = moment / (3 * twice);
  return part;
}

PartModel rectangle(double length, double width) {
  PartModel part;
  part.corners[0] = {-length / 2, -width / 2};
  part.corners[1] = {length / 2, -width / 2};
  part.corners[2] = {length / 2, width / 2};
  part.corners[3] = {-length / 2, width / 2};
  part.corner_count = 4;
  part.symmetry = 2;
  return part;
}

/// The first corner along x.
PartModel regular(std::size_t corners, double radius) {
  PartModel part;
  for (std::size_t i = 0; i < corners; ++i) {
    const double angle = 2 * pi * static_cast<double>(i) / static_cast<double>(corners);
    part.corners[i] = {radius * std::cos(angle), radius * std::sin(angle)};
  }
  part.corner_count = corners;
  part.symmetry = static_cast<int>(corners);
  return part;
}

/// An L whose arms lie along x and y, so wide, about its centroid.
PartModel angle_bracket(double length, double width, double arm) {
  PartModel part;
  const double foot = length * arm;
  const double leg = (width - arm) * arm;
  const Eigen::Vector2d middle((foot * length / 2 + leg * arm / 2) / (foot + leg),
                               (foot * arm / 2 + leg * (width + arm) / 2) / (foot + leg));
  part.corners[0] = Eigen::Vector2d(0, 0) - middle;
  part.corners[1] = Eigen::Vector2d(length, 0) - middle;
  part.corners[2] = Eigen::Vector2d(length, arm) - middle;
  part.corners[3] = Eigen::Vector2d(arm, arm) - middle;
  part.corners[4] = Eigen::Vector2d(arm, width) - middle;
  part.corners[5] = Eigen::Vector2d(0, width) - middle;
  part.corner_count = 6;
  return part;
}

PartModel named(PartModel part, const char* name, double height, SurfaceColour colour) {
  part.name = name;
  part.height = height;
  part.colour = colour;
  return complete(part);
}

std::array<PartModel, kinds> make_parts() {
  PartModel disc = regular(24, 0.020);
  disc.symmetry = 0;
  return {named(rectangle(0.050, 0.030), "block", 0.025, {40, 90, 200}),
          named(disc, "disc", 0.020, {230, 120, 30}),
          named(regular(6, 0.036 / std::sqrt(3.0)), "hexagon", 0.022, {50, 160, 70}),
          named(angle_bracket(0.050, 0.040, 0.018), "bracket", 0.020, {220, 190, 40})};
}

}  // namespace

std::span<const PartModel> known_parts() noexcept {
  static const std::array<PartModel, kinds> parts = make_parts();
  return parts;
}

SurfaceColour known_table_colour() noexcept {
  return {150, 145, 135};
}

double within_symmetry(double angle, int symmetry) noexcept {
  if (symmetry == 0) return 0;
  const double turn = 2 * pi / symmetry;
  return angle - turn * std::floor(angle / turn + 0.5);
}

}  // namespace flexrf::user
