#include "units/vision/pose_starts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flexrf::user {
namespace {

constexpr double half_turn = std::numbers::pi;
constexpr double least_turn = 35 * half_turn / 180;       // of a corner of a contour
constexpr double most_difference = 30 * half_turn / 180;  // of two corners that may be one
constexpr double around_a_corner = 0.007;                 // m along the contour, each way
constexpr std::size_t places_along = 24;                  // of a part without corners

double angle_of(const Eigen::Vector2d& vector) {
  return std::atan2(vector.y(), vector.x());
}

/// By which one has to turn to the left to face the other way.
double turn_between(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  return std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
}

/// Of the outline's side that begins at this corner; not of unit length.
Eigen::Vector2d outwards(const PartModel& part, std::size_t corner) {
  const Eigen::Vector2d side = part.corners[(corner + 1) % part.corner_count] - part.corners[corner];
  return Eigen::Vector2d(side.y(), -side.x()).normalized();
}

Eigen::Vector2d turned(const Eigen::Vector2d& vector, double angle) {
  const double cosine = std::cos(angle);
  const double sine = std::sin(angle);
  return {cosine * vector.x() - sine * vector.y(), sine * vector.x() + cosine * vector.y()};
}

}  // namespace

bool PoseStarts::add(const OutlinePose& pose) noexcept {
  if (count_ == most) return false;
  poses_[count_++] = pose;
  return true;
}

void PoseStarts::add_around(const PartModel& part, const Eigen::Vector2d& middle) noexcept {
  const double range = part.symmetry == 0 ? 0 : 2 * half_turn / part.symmetry;
  const int angles = std::max(1, static_cast<int>(std::lround(range / (half_turn / 6))));
  for (int i = 0; i < angles; ++i) {
    OutlinePose pose;
    pose.angle = range * i / angles;
    pose.position = middle - turned(part.middle, pose.angle);
    if (!add(pose)) return;
  }
}

void PoseStarts::add_at_corners(const PartModel& part, std::span<const ContourPoint> points) noexcept {
  const std::size_t count = points.size();
  if (count < 16) return;
  if (part.symmetry == 0) {
    for (std::size_t i = 0; i < places_along; ++i) {
      const ContourPoint& point = points[i * count / places_along];
      if (point.is_edge) add({point.position - part.radius * point.normal, 0});
    }
    return;
  }
  double length = 0;
  for (std::size_t i = 0; i < count; ++i)
    length += (points[(i + 1) % count].position - points[i].position).norm();
  const double spacing = std::max(length / static_cast<double>(count), 1e-6);
  const auto reach = static_cast<std::size_t>(
      std::clamp(around_a_corner / spacing, 2.0, std::max(2.0, static_cast<double>(count) / 8)));
  std::array<double, Contour::most_points> turns{};
  const std::size_t used = std::min(count, turns.size());
  for (std::size_t i = 0; i < used; ++i)
    turns[i] = turn_between(points[(i + count - reach) % count].normal, points[(i + reach) % count].normal);
  for (std::size_t i = 0; i < used; ++i) {
    if (turns[i] < least_turn || !points[i].is_edge) continue;
    bool is_sharpest = true;
    for (std::size_t k = 1; k <= reach && is_sharpest; ++k)
      is_sharpest = turns[i] >= turns[(i + k) % used] && turns[i] > turns[(i + used - k) % used];
    if (!is_sharpest) continue;
    const Eigen::Vector2d bisector =
        points[(i + count - reach) % count].normal + points[(i + reach) % count].normal;
    add_corner(part, points[i], bisector, turns[i]);
  }
}

/// On each corner of the outline that symmetry does not make the same as another one.
void PoseStarts::add_corner(const PartModel& part, const ContourPoint& at, const Eigen::Vector2d& bisector,
                            double turn) noexcept {
  const std::size_t different = part.corner_count / static_cast<std::size_t>(part.symmetry);
  for (std::size_t corner = 0; corner < different; ++corner) {
    const Eigen::Vector2d before = outwards(part, (corner + part.corner_count - 1) % part.corner_count);
    const Eigen::Vector2d behind = outwards(part, corner);
    if (std::abs(turn_between(before, behind) - turn) > most_difference) continue;
    OutlinePose pose;
    pose.angle = angle_of(bisector) - angle_of(before + behind);
    pose.position = at.position - turned(part.corners[corner], pose.angle);
    if (!add(pose)) return;
  }
}

}  // namespace flexrf::user
