#include "units/vision/part_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hal/scene/interface/part_catalogue.hpp"

namespace flexrf::user {
namespace {

constexpr double pi = std::numbers::pi;

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
    OutlineSide& side = part.sides[i];
    side.from = from;
    side.length = (to - from).norm();
    side.along = (to - from) / side.length;
    side.outwards = {side.along.y(), -side.along.x()};
    part.perimeter += side.length;
    part.radius = std::max(part.radius, from.norm());
  }
  part.area = twice / 2;
  part.middle = moment / (3 * twice);
  std::size_t side = 0;
  double begin = 0;  // of the side, along the outline
  for (std::size_t i = 0; i < outline_stations; ++i) {
    const double at = part.perimeter * (static_cast<double>(i) + 0.5) / outline_stations;
    while (at > begin + part.sides[side].length && side + 1 < part.corner_count)
      begin += part.sides[side++].length;
    part.stations[i] = part.sides[side].from + part.sides[side].along * (at - begin);
  }
  return part;
}

PartModel from_drawing(const flexrf::PartModel& drawing) {
  PartModel part;
  part.name = drawing.name;
  part.height = drawing.height;
  part.colour = {drawing.colour.red, drawing.colour.green, drawing.colour.blue};
  part.symmetry = drawing.symmetry;
  for (const PlaneVector& corner : drawing.outline.all())
    part.corners[part.corner_count++] = {corner.x, corner.y};
  return complete(part);
}

std::array<PartModel, part_kinds> make_parts() {
  std::array<PartModel, part_kinds> parts;
  std::transform(part_catalogue.begin(), part_catalogue.end(), parts.begin(), from_drawing);
  return parts;
}

}  // namespace

std::span<const PartModel> known_parts() noexcept {
  static const std::array<PartModel, part_kinds> parts = make_parts();
  return parts;
}

SurfaceColour known_table_colour() noexcept {
  return {table_colour.red, table_colour.green, table_colour.blue};
}

double within_symmetry(double angle, int symmetry) noexcept {
  if (symmetry == 0) return 0;
  const double turn = 2 * pi / symmetry;
  return angle - turn * std::floor(angle / turn + 0.5);
}

}  // namespace flexrf::user
