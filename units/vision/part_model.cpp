#include "units/vision/part_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flexrf::user {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double same_place = 1e-6;  // m, of grasps
constexpr double same_angle = 1e-6;  // rad

Eigen::Vector2d place_of(const OutlineCorner& corner) {
  return {corner.x, corner.y};
}

std::size_t corners_of(const PartDrawing& drawing) {
  std::size_t count = drawing.outline.size();
  while (count > 0 && place_of(drawing.outline[count - 1]).isZero()) --count;
  return count;
}

double area_of(std::span<const Eigen::Vector2d> outline) {
  double twice = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d& next = outline[(i + 1) % outline.size()];
    twice += outline[i].x() * next.y() - outline[i].y() * next.x();
  }
  return twice / 2;
}

/// Two sides that are no neighbours cross.
bool crosses_itself(std::span<const Eigen::Vector2d> outline) {
  const std::size_t count = outline.size();
  const auto side_of = [](const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Eigen::Vector2d& at) {
    const Eigen::Vector2d along = to - from;
    return along.x() * (at.y() - from.y()) - along.y() * (at.x() - from.x());
  };
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = i + 2; k < count; ++k) {
      if (i == 0 && k + 1 == count) continue;
      const Eigen::Vector2d& a = outline[i];
      const Eigen::Vector2d& b = outline[i + 1];
      const Eigen::Vector2d& c = outline[k];
      const Eigen::Vector2d& d = outline[(k + 1) % count];
      if (side_of(a, b, c) * side_of(a, b, d) < 0 && side_of(c, d, a) * side_of(c, d, b) < 0) return true;
    }
  }
  return false;
}

/// What keeps it from being a part; null: nothing.
const char* fault_in(const PartDrawing& drawing, const PartModel& part) {
  if (drawing.radius != 0 && corners_of(drawing) > 0) return "has an outline and a radius: give one of them";
  if (part.corner_count < 3) return "needs an outline of at least 3 corners, or a radius";
  if (drawing.radius < 0) return "has a radius below 0";
  if (crosses_itself(part.outline())) return "has an outline that crosses itself";
  if (area_of(part.outline()) <= 0) return "has an outline that does not run counter-clockwise";
  if (part.height <= 0) return "needs a height above 0 m";
  const auto& size = drawing.bin.size;
  if ((size[0] > 0) != (size[1] > 0) || size[0] < 0 || size[1] < 0)
    return "has a bin whose size is not above 0 m in both directions";
  const bool is_good = std::all_of(drawing.grasps.begin(), drawing.grasps.end(),
                                   [](const PartGrasp& grasp) { return grasp.width >= 0; });
  return is_good ? nullptr : "has a grasp with a width below 0 m";
}

/// What follows from the outline.
void complete(PartModel& part) {
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
}

/// Fingers that are turned by half a turn take it alike.
bool is_same(const PartGrasp& one, const PartGrasp& other) {
  return std::abs(one.x - other.x) < same_place && std::abs(one.y - other.y) < same_place &&
         std::abs(std::remainder(one.angle - other.angle, pi)) < same_angle;
}

/// Adds each grasp with those that look the same. False: there are more than most_grasps.
bool add_grasps(PartModel& part, const PartDrawing& drawing) {
  constexpr int round_turns = 24;
  const int turns = part.symmetry == 0 ? round_turns : part.symmetry;
  for (const PartGrasp& drawn : drawing.grasps) {
    if (drawn.width == 0) continue;
    for (int i = 0; i < turns; ++i) {
      const double turn = 2 * pi * i / turns;
      PartGrasp grasp = drawn;
      grasp.x = std::cos(turn) * drawn.x - std::sin(turn) * drawn.y;
      grasp.y = std::sin(turn) * drawn.x + std::cos(turn) * drawn.y;
      grasp.angle = drawn.angle + turn;
      const auto known = part.all_grasps();
      if (std::any_of(known.begin(), known.end(), [&](const PartGrasp& one) { return is_same(one, grasp); }))
        continue;
      if (part.grasp_count == most_grasps) return false;
      part.grasps[part.grasp_count++] = grasp;
    }
  }
  return true;
}

PartModel from_drawing(const PartDrawing& drawing) {
  PartModel part;
  const std::string_view name = drawing.name_view();
  std::copy_n(name.begin(), std::min(name.size(), part.name.size() - 1), part.name.begin());
  part.height = drawing.height;
  part.colour = drawing.colour;
  part.symmetry = drawing.symmetry;
  part.bin = drawing.bin;
  if (drawing.radius > 0) {
    part.corner_count = most_corners;
    for (std::size_t i = 0; i < most_corners; ++i) {
      const double angle = 2 * pi * static_cast<double>(i) / most_corners;
      part.corners[i] = {drawing.radius * std::cos(angle), drawing.radius * std::sin(angle)};
    }
  } else {
    part.corner_count = corners_of(drawing);
    std::transform(drawing.outline.begin(),
                   drawing.outline.begin() + static_cast<std::ptrdiff_t>(part.corner_count),
                   part.corners.begin(), place_of);
  }
  return part;
}

}  // namespace

Status KnownParts::take(const PartCatalogue& catalogue) noexcept {
  count_ = 0;
  const SurfaceColour& table = catalogue.table;
  if (table.red == 0 || table.green == 0 || table.blue == 0)
    return Status::error(
        StatusCode::invalid_argument,
        "catalogue: the table has no red, green or blue; give the colour of the bare table, by "
        "which the light is told");
  std::size_t count = 0;
  for (std::size_t i = 0; i < catalogue.parts.size(); ++i) {
    const PartDrawing& drawing = catalogue.parts[i];
    if (drawing.name_view().empty()) continue;
    if (i != count)
      return Status::error(StatusCode::invalid_argument,
                           "catalogue: part %zu has no name, but one behind it has", count + 1);
    PartModel part = from_drawing(drawing);
    if (const char* const fault = fault_in(drawing, part); fault != nullptr)
      return Status::error(StatusCode::invalid_argument, "catalogue: '%s' %s", part.name.data(), fault);
    complete(part);
    if (!add_grasps(part, drawing))
      return Status::error(StatusCode::invalid_argument,
                           "catalogue: '%s' has more than %zu grasps, with those that its symmetry makes",
                           part.name.data(), most_grasps);
    models_[count++] = part;
  }
  if (count == 0)
    return Status::error(StatusCode::invalid_argument,
                         "catalogue: there is no part in it; draw the parts that lie on the table");
  count_ = count;
  return {};
}

double within_symmetry(double angle, int symmetry) noexcept {
  if (symmetry == 0) return 0;
  const double turn = 2 * pi / symmetry;
  return angle - turn * std::floor(angle / turn + 0.5);
}

}  // namespace flexrf::user
