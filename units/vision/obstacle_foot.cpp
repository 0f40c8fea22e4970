#include "units/vision/obstacle_foot.hpp"

#include <algorithm>
#include <array>

namespace flexrf::user {
namespace {

constexpr double along_the_sight = 0.25;    // cosine between a normal and the way from below the camera
constexpr std::size_t most_of_a_foot = 64;  // points that the disc is laid about
constexpr double height_step = 0.01;        // m, over which the lean is measured

struct FootPoints {
  std::array<Eigen::Vector2d, most_of_a_foot> near;
  std::array<Eigen::Vector2d, most_of_a_foot> far;
  std::size_t near_count = 0;
  std::size_t far_count = 0;
};

struct Disc {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  double radius = 0;
};

/// The smallest disc, to a hundredth of its radius (Badoiu and Clarkson 2003).
Disc disc_about(const FootPoints& points, const Eigen::Vector2d& below_camera, double scale) {
  std::array<Eigen::Vector2d, 2 * most_of_a_foot> all;
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.near_count; ++i) all[count++] = points.near[i];
  for (std::size_t i = 0; i < points.far_count; ++i)
    all[count++] = below_camera + (points.far[i] - below_camera) * scale;
  Disc disc;
  disc.middle.setZero();
  for (std::size_t i = 0; i < count; ++i) disc.middle += all[i] / static_cast<double>(count);
  constexpr int steps = 60;
  for (int step = 1; step <= steps; ++step) {
    Eigen::Vector2d farthest = disc.middle;
    double most = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const double away = (all[i] - disc.middle).squaredNorm();
      if (away <= most) continue;
      most = away;
      farthest = all[i];
    }
    disc.radius = std::sqrt(most);
    if (step < steps) disc.middle += (farthest - disc.middle) / (step + 1);
  }
  return disc;
}

}  // namespace

bool find_foot(std::span<const ContourPoint> points, const CameraView& view, double height,
               ObstacleFoot& foot) noexcept {
  const double above = view.position().z();
  if (points.empty() || !(above > height + height_step)) return false;
  const Eigen::Vector2d below_camera = view.position().head<2>();
  FootPoints seen;
  const std::size_t stride = (points.size() + most_of_a_foot - 1) / most_of_a_foot;
  for (std::size_t i = 0; i < points.size(); i += stride) {
    const Eigen::Vector2d outwards = points[i].position - below_camera;
    const double facing = points[i].normal.dot(outwards) / std::max(outwards.norm(), 1e-9);
    if (facing < -along_the_sight)
      seen.near[seen.near_count++] = points[i].position;
    else if (facing > along_the_sight)
      seen.far[seen.far_count++] = points[i].position;
  }
  if (seen.near_count + seen.far_count == 0) return false;
  const Disc disc = disc_about(seen, below_camera, (above - height) / above);
  const Disc of_a_higher = disc_about(seen, below_camera, (above - height - height_step) / above);
  foot.middle = disc.middle;
  foot.radius = disc.radius;
  foot.lean.head<2>() = (of_a_higher.middle - disc.middle) / height_step;
  foot.lean[2] = (of_a_higher.radius - disc.radius) / height_step;
  return true;
}

}  // namespace flexrf::user
