// Fitting a part's outline to points of a contour, of which some may belong to something else.
#pragma once

#include <span>

#include "units/vision/contour.hpp"
#include "units/vision/part_model.hpp"

namespace flexrf::user {

/// Where a part's outline lies on the plane of its top, in the robot's frame.
struct OutlinePose {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< of the outline's origin, m
  double angle = 0;                                    ///< rad
};

struct OutlineFit {
  OutlinePose pose;
  double residual = 0;  ///< m, root mean square distance of the points that count
  double support = 0;   ///< part of the outline that has a point of the contour beside it
};

/// How much of the contour lies at the outline: the mean over the points of 1 at it, 0 from `width` (m) on
/// (Tukey's biweight). Looks at every `stride`-th point.
double agreement(const PartModel& part, const OutlinePose& pose, std::span<const ContourPoint> points,
                 double width, std::size_t stride) noexcept;

/// Moves the outline to where the points that lie near it say (iterated closest point with distances to
/// lines, Chen and Medioni 1992; weights by Tukey's biweight, whose width falls from `width` in each of
/// `iterations`, so that points of other parts lose their say). Points that face another way than the outline
/// there do not count. Allocates nothing; 24 corners, 256 points and 8 iterations take about 0.1 ms.
OutlineFit fit_outline(const PartModel& part, const OutlinePose& start, std::span<const ContourPoint> points,
                       double width, int iterations) noexcept;

/// Whether the point lies within the outline.
bool is_within(const PartModel& part, const OutlinePose& pose, const Eigen::Vector2d& point) noexcept;

/// Of the point from the outline, m; never negative.
double distance_from(const PartModel& part, const OutlinePose& pose, const Eigen::Vector2d& point) noexcept;

}  // namespace flexrf::user
