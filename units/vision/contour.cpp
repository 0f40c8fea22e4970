#include "units/vision/contour.hpp"

#include <algorithm>
#include <cmath>

namespace flexrf::user {
namespace {

struct Direction {
  int x = 0;
  int y = 0;
};
// Clockwise as one sees the picture: the blob is always to the right.
constexpr std::array<Direction, 4> directions{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

/// Of the two cells ahead of a corner of the grid, when one arrives in this direction.
struct Ahead {
  Direction right;
  Direction left;
};
constexpr std::array<Ahead, 4> ahead{
    {{{0, 0}, {0, -1}}, {{-1, 0}, {0, 0}}, {{-1, -1}, {-1, 0}}, {{0, -1}, {-1, -1}}}};

}  // namespace

bool Contour::follow(const RegionBitmap& bitmap, const Blob& blob, const CameraView& view,
                     double height) noexcept {
  count_ = 0;
  area_ = 0;
  if (!trace(bitmap, blob) || !project(bitmap, view, height)) return false;
  find_normals();
  // To the one outline: s is the size of the bottom's image on the plane of the top, as seen from above.
  const double shrunk = (view.position().z() - height) / view.position().z();
  const Eigen::Vector2d below_camera = view.position().head<2>();
  for (ContourPoint& point : points()) {
    const Eigen::Vector2d outwards = point.position - below_camera;
    if (point.normal.dot(outwards) < 0) point.position = below_camera + outwards / shrunk;
  }
  measure();
  return count_ >= 8;
}

double Contour::seen() const noexcept {
  const auto edges = std::count_if(points_.begin(), points_.begin() + static_cast<std::ptrdiff_t>(count_),
                                   [](const ContourPoint& point) { return point.is_edge; });
  return count_ == 0 ? 0.0 : static_cast<double>(edges) / static_cast<double>(count_);
}

/// Along the sides of cells (crack code), from the upper side of the first cell.
bool Contour::trace(const RegionBitmap& bitmap, const Blob& blob) noexcept {
  step_count_ = 0;
  meets_blind_ = false;
  int x = blob.first_column;
  int y = blob.top;
  std::size_t heading = 0;
  const auto is_inside = [&](Direction offset) {
    return bitmap.label(x + offset.x, y + offset.y) == blob.label;
  };
  do {
    if (step_count_ == most_steps) return false;
    const Direction step = directions[heading];
    Step& one = steps_[step_count_++];
    one.column = static_cast<float>(x) + 0.5F * static_cast<float>(step.x);
    one.row = static_cast<float>(y) + 0.5F * static_cast<float>(step.y);
    // At the border of what was looked at nobody knows whether the part goes on.
    const Direction outside = ahead[heading].left;
    one.is_edge = bitmap.is_seen(x + outside.x, y + outside.y);
    meets_blind_ = meets_blind_ || bitmap.is_blind(x + outside.x, y + outside.y);
    x += step.x;
    y += step.y;
    if (!is_inside(ahead[heading].right)) {
      heading = (heading + 1) % 4;
    } else if (is_inside(ahead[heading].left)) {
      heading = (heading + 3) % 4;
    }
  } while (x != blob.first_column || y != blob.top || heading != 0);
  return true;
}

bool Contour::project(const RegionBitmap& bitmap, const CameraView& view, double height) noexcept {
  count_ = std::min(step_count_, most_points);
  // Of a square of pixels the first was looked at.
  const double offset = 0.5 * (bitmap.scale() - 1);
  for (std::size_t i = 0; i < count_; ++i) {
    const Step& step = steps_[i * step_count_ / count_];
    ContourPoint& point = points_[i];
    point.is_edge = step.is_edge;
    const double column = bitmap.rectangle().left + static_cast<double>(step.column) * bitmap.scale();
    const double row = bitmap.rectangle().top + static_cast<double>(step.row) * bitmap.scale();
    if (!view.to_plane(column - offset, row - offset, height, point.position)) return false;
  }
  return true;
}

/// Across the line from some points before to as many behind, about 4 mm each way: less would see the cells'
/// corners.
void Contour::find_normals() noexcept {
  measure();
  double length = 0;
  for (std::size_t i = 0; i < count_; ++i)
    length += (points_[(i + 1) % count_].position - points_[i].position).norm();
  // The way along cells' sides is up to 1.4 times as long as the boundary.
  const double spacing = std::max(length / static_cast<double>(count_), 1e-6);
  const double most = std::max(static_cast<double>(count_) / 8, 2.0);
  const auto reach = static_cast<std::size_t>(std::clamp(0.005 / spacing, 2.0, most));
  const double turn = area_ < 0 ? -1 : 1;
  for (std::size_t i = 0; i < count_; ++i) {
    const Eigen::Vector2d along =
        points_[(i + reach) % count_].position - points_[(i + count_ - reach) % count_].position;
    const double norm = along.norm();
    points_[i].normal = norm > 0 ? Eigen::Vector2d(Eigen::Vector2d(along.y(), -along.x()) * (turn / norm))
                                 : Eigen::Vector2d(0, 0);
  }
  // Counter-clockwise from here on.
  if (area_ < 0) std::reverse(points_.begin(), points_.begin() + static_cast<std::ptrdiff_t>(count_));
}

void Contour::measure() noexcept {
  double twice = 0;
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  const Eigen::Vector2d origin = points_[0].position;
  for (std::size_t i = 0; i < count_; ++i) {
    const Eigen::Vector2d from = points_[i].position - origin;
    const Eigen::Vector2d to = points_[(i + 1) % count_].position - origin;
    const double cross = from.x() * to.y() - from.y() * to.x();
    twice += cross;
    moment += (from + to) * cross;
  }
  area_ = twice / 2;
  middle_ = std::abs(twice) > 0 ? Eigen::Vector2d(origin + moment / (3 * twice)) : origin;
}

}  // namespace flexrf::user
