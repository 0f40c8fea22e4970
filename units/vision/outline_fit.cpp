#include "units/vision/outline_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace flexrf::user {
namespace {

constexpr double narrowest = 0.0012;         // m, of the weights' width: two pixels or so
constexpr double beside = 0.0016;            // m: such a point supports the outline
constexpr double least_facing = 0.5;         // cosine of the angle between two that face the same way
constexpr std::size_t points_at_first = 64;  // by which it is brought near
constexpr std::size_t points_at_last = 128;  // of the last two iterations

/// Of a point from the outline, in the outline's frame.
struct Closest {
  double distance_squared = 1e30;
  Eigen::Vector2d direction = Eigen::Vector2d::Zero();  // unit vector, along which the distance is measured
  double distance = 0;                                  // along that; above 0: outside
};

/// What looks the same at every angle is a circle. A point in its middle is as far from all of it.
Closest closest_on_circle(double radius, const Eigen::Vector2d& point, const Eigen::Vector2d& normal) {
  Closest best;
  const double from_middle = point.norm();
  const Eigen::Vector2d outwards =
      from_middle > 1e-9 ? Eigen::Vector2d(point / from_middle) : Eigen::Vector2d(1, 0);
  if (normal.dot(outwards) < least_facing * normal.norm()) return best;
  best.distance = from_middle - radius;
  best.distance_squared = best.distance * best.distance;
  best.direction = outwards;
  return best;
}

/// `normal` zero: whichever way it faces.
Closest closest_on(const PartModel& part, const Eigen::Vector2d& point, const Eigen::Vector2d& normal) {
  if (part.symmetry == 0) return closest_on_circle(part.perimeter / (2 * std::numbers::pi), point, normal);
  Closest best;
  const double least = least_facing * normal.norm();
  for (const OutlineSide& side : part.all_sides()) {
    if (normal.dot(side.outwards) < least) continue;
    const Eigen::Vector2d offset = point - side.from;
    const double along = offset.dot(side.along);
    const double across = offset.dot(side.outwards);
    // Beyond the side's end the distance is that to its corner.
    const double beyond = along < 0 ? along : std::max(along - side.length, 0.0);
    const double distance_squared = across * across + beyond * beyond;
    if (distance_squared >= best.distance_squared) continue;
    best.distance_squared = distance_squared;
    best.direction = side.outwards;
    best.distance = across;
    if (beyond == 0.0) continue;
    best.distance = std::sqrt(distance_squared);
    best.direction = (across * side.outwards + beyond * side.along) / best.distance;
  }
  return best;
}

double biweight(double distance_squared, double width) {
  const double share = 1 - distance_squared / (width * width);
  return share > 0 ? share * share : 0.0;
}

/// From the robot's frame to the outline's, and back.
struct Frame {
  explicit Frame(const OutlinePose& pose)
      : position(pose.position), cosine(std::cos(pose.angle)), sine(std::sin(pose.angle)) {}
  Eigen::Vector2d turned_back(const Eigen::Vector2d& vector) const {
    return {cosine * vector.x() + sine * vector.y(), cosine * vector.y() - sine * vector.x()};
  }
  Eigen::Vector2d to_own(const Eigen::Vector2d& point) const { return turned_back(point - position); }
  Eigen::Vector2d turned(const Eigen::Vector2d& vector) const {
    return {cosine * vector.x() - sine * vector.y(), sine * vector.x() + cosine * vector.y()};
  }

  Eigen::Vector2d position;
  double cosine;
  double sine;
};

/// One step of Gauss and Newton. False: the points do not say where to go.
bool improve(const PartModel& part, OutlinePose& pose, std::span<const ContourPoint> points, double width,
             std::size_t stride) {
  const Frame frame(pose);
  Eigen::Matrix3d normal_matrix = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right_side = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < points.size(); i += stride) {
    const ContourPoint& point = points[i];
    if (!point.is_edge) continue;
    const Eigen::Vector2d own = frame.to_own(point.position);
    const Closest closest = closest_on(part, own, frame.turned_back(point.normal));
    const double weight = biweight(closest.distance_squared, width);
    if (weight <= 0) continue;
    const Eigen::Vector3d row(closest.direction.x(), closest.direction.y(),
                              closest.direction.y() * own.x() - closest.direction.x() * own.y());
    normal_matrix += weight * row * row.transpose();
    right_side -= weight * closest.distance * row;
  }
  const double scale = normal_matrix(0, 0) + normal_matrix(1, 1);
  if (!(scale > 3)) return false;
  // What looks the same at every angle has none to find; a little damping where the points say nothing.
  if (part.symmetry == 0) {
    normal_matrix.row(2).setZero();
    normal_matrix.col(2).setZero();
    normal_matrix(2, 2) = 1;
    right_side(2) = 0;
  }
  normal_matrix(0, 0) += 1e-6 * scale;
  normal_matrix(1, 1) += 1e-6 * scale;
  normal_matrix(2, 2) += 1e-6 * scale * part.radius * part.radius;
  const Eigen::Vector3d step = normal_matrix.ldlt().solve(right_side);
  if (!step.allFinite()) return false;
  // The points would move by `step` in the outline's frame, so the outline moves the other way.
  pose.angle -= step(2);
  pose.position -= Frame(pose).turned(Eigen::Vector2d(step.head<2>()));
  return true;
}

double support_of(const PartModel& part, const OutlinePose& pose, std::span<const ContourPoint> points) {
  // Points once in the outline's frame, then each station against all.
  std::array<Eigen::Vector2d, Contour::most_points> own;
  const Frame frame(pose);
  std::size_t count = 0;
  for (const ContourPoint& point : points)
    if (point.is_edge && count < own.size()) own[count++] = frame.to_own(point.position);
  // Both go around the outline, so the next station's point is about where the last one's was.
  std::size_t supported = 0;
  std::size_t last = 0;
  for (const Eigen::Vector2d& station : part.stations) {
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t at = last + k < count ? last + k : last + k - count;
      if ((own[at] - station).squaredNorm() > beside * beside) continue;
      ++supported;
      last = at;
      break;
    }
  }
  return static_cast<double>(supported) / outline_stations;
}

}  // namespace

double agreement(const PartModel& part, const OutlinePose& pose, std::span<const ContourPoint> points,
                 double width, std::size_t stride) noexcept {
  const Frame frame(pose);
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.size(); i += stride) {
    ++count;
    if (!points[i].is_edge) continue;
    const Closest closest =
        closest_on(part, frame.to_own(points[i].position), frame.turned_back(points[i].normal));
    sum += biweight(closest.distance_squared, width);
  }
  return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

OutlineFit fit_outline(const PartModel& part, const OutlinePose& start, std::span<const ContourPoint> points,
                       double width, int iterations) noexcept {
  OutlineFit fit;
  fit.pose = start;
  double now = width;
  const std::size_t coarse = std::max<std::size_t>(points.size() / points_at_first, 1);
  const std::size_t fine = std::max<std::size_t>(points.size() / points_at_last, 1);
  for (int i = 0; i < iterations; ++i) {
    if (!improve(part, fit.pose, points, now, i + 2 < iterations ? coarse : fine)) return fit;
    now = std::max(0.6 * now, narrowest);
  }
  const Frame frame(fit.pose);
  double squares = 0;
  double weights = 0;
  for (std::size_t i = 0; i < points.size(); i += fine) {
    const ContourPoint& point = points[i];
    if (!point.is_edge) continue;
    const Closest closest = closest_on(part, frame.to_own(point.position), frame.turned_back(point.normal));
    const double weight = biweight(closest.distance_squared, 2 * narrowest);
    squares += weight * closest.distance_squared;
    weights += weight;
  }
  fit.residual = weights > 0 ? std::sqrt(squares / weights) : width;
  fit.support = support_of(part, fit.pose, points);
  fit.pose.angle = within_symmetry(fit.pose.angle, part.symmetry);
  return fit;
}

bool is_within(const PartModel& part, const OutlinePose& pose, const Eigen::Vector2d& point) noexcept {
  const Eigen::Vector2d own = Frame(pose).to_own(point);
  bool inside = false;
  for (std::size_t i = 0, before = part.corner_count - 1; i < part.corner_count; before = i++) {
    const Eigen::Vector2d& a = part.corners[i];
    const Eigen::Vector2d& b = part.corners[before];
    if ((a.y() > own.y()) != (b.y() > own.y()) &&
        own.x() < a.x() + (b.x() - a.x()) * (own.y() - a.y()) / (b.y() - a.y()))
      inside = !inside;
  }
  return inside;
}

double distance_from(const PartModel& part, const OutlinePose& pose, const Eigen::Vector2d& point) noexcept {
  return std::sqrt(closest_on(part, Frame(pose).to_own(point), Eigen::Vector2d::Zero()).distance_squared);
}

}  // namespace flexrf::user
