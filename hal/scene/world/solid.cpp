#include "hal/scene/world/solid.hpp"

#include <algorithm>

namespace flexrf {
namespace {

PlaneVector seen_from_above(const Eigen::Vector3d& point) noexcept {
  return {point.x(), point.y()};
}

/// What of a line is between two heights: the part of it, from 0 to 1. False: nothing is.
bool clip(double from, double to, double low, double high, double& begin, double& end) noexcept {
  begin = 0;
  end = 1;
  if (from == to) return from >= low && from <= high;
  const double at_low = (low - from) / (to - from);
  const double at_high = (high - from) / (to - from);
  begin = std::max(begin, std::min(at_low, at_high));
  end = std::min(end, std::max(at_low, at_high));
  return begin <= end;
}

}  // namespace

Solid::Solid(const std::array<Eigen::Vector3d, 8>& corners) noexcept : corners_(corners), count_(8) {
  bound(0);
}

Solid::Solid(const Capsule& capsule) noexcept : Solid() {
  count_ = 2;
  radius_ = capsule.radius;
  stands_ = capsule.stands;
  corners_[0] = capsule.from;
  corners_[1] = capsule.to;
  bound(capsule.radius);
}

void Solid::bound(double margin) noexcept {
  low_ = high_ = corners_[0].z();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < count_; ++i) {
    low_ = std::min(low_, corners_[i].z());
    high_ = std::max(high_, corners_[i].z());
    sum += corners_[i];
  }
  low_ -= margin;
  high_ += margin;
  middle_ = seen_from_above(sum / static_cast<double>(count_));
  reach_ = 0;
  for (std::size_t i = 0; i < count_; ++i)
    reach_ = std::max(reach_, length(seen_from_above(corners_[i]) - middle_) + margin);
}

Outline Solid::section(double low, double high) const noexcept {
  std::array<PlaneVector, 48> points;
  std::size_t count = 0;
  const auto add_line = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to, double margin) {
    double begin = 0;
    double end = 1;
    if (!clip(from.z(), to.z(), low - margin, high + margin, begin, end)) return false;
    points[count++] = seen_from_above(from + (to - from) * begin);
    points[count++] = seen_from_above(from + (to - from) * end);
    return true;
  };
  if (count_ == 8) {
    for (std::size_t corner = 0; corner < 8; ++corner)
      for (const std::size_t axis : {1U, 2U, 4U})
        if ((corner & axis) == 0) add_line(corners_[corner], corners_[corner | axis], 0);
  } else if (count_ == 2 && add_line(corners_[0], corners_[1], radius_)) {
    constexpr double around = 1.0352761804100830;  // twelve sides that have the circle within
    const PlaneVector ends[] = {points[0], points[1]};
    count = 0;
    for (const PlaneVector end : ends)
      for (std::size_t i = 0; i < most_corners; i += 2)
        points[count++] = end + circle_directions()[i] * (radius_ * around);
  }
  return hull_of({points.data(), count});
}

}  // namespace flexrf
