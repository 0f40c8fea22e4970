#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace flexrf {

/// From the place to the nearest point of the line between `from` and `to`; all in m.
inline double distance_to_line(const Eigen::Vector3d& place, const Eigen::Vector3d& from,
                               const Eigen::Vector3d& to) {
  const Eigen::Vector3d way = to - from;
  const double square = way.squaredNorm();
  const double along = square > 0 ? std::clamp((place - from).dot(way) / square, 0.0, 1.0) : 0;
  return (place - from - along * way).norm();
}

}  // namespace flexrf
