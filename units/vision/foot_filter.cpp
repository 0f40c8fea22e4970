#include "units/vision/foot_filter.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace flexrf::user {
namespace {

constexpr double height_deviation = 0.03;  // m, of the assumed height
constexpr double anywhere = 1;             // m, before the first view
constexpr double same_view = 0.03;         // of the lean
constexpr double most_views = 10;          // that the radius is the mean of

}  // namespace

void FootFilter::begin(const SeenFoot& foot, double deviation) noexcept {
  state_ = {foot.middle.x(), foot.middle.y(), foot.height};
  covariance_ = Eigen::Vector3d(anywhere, anywhere, height_deviation).cwiseAbs2().asDiagonal();
  radius_ = radius_lean_ = views_ = 0;
  assumed_ = foot.height;
  take(foot, deviation);
}

void FootFilter::correct(const SeenFoot& foot, double deviation) noexcept {
  const bool is_same = (foot.lean - last_lean_).norm() < same_view;
  if (is_same && (foot.middle - expected(foot)).norm() < 3 * deviation) return;
  take(foot, deviation);
}

/// Where such a view would show its middle.
Eigen::Vector2d FootFilter::expected(const SeenFoot& foot) const noexcept {
  return middle() - foot.lean.head<2>() * (state_[2] - foot.height);
}

void FootFilter::take(const SeenFoot& foot, double deviation) noexcept {
  last_lean_ = foot.lean;
  Eigen::Matrix<double, 2, 3> view = Eigen::Matrix<double, 2, 3>::Zero();
  view.leftCols<2>().setIdentity();
  view.col(2) = -foot.lean.head<2>();
  const Eigen::Matrix2d total =
      view * covariance_ * view.transpose() + Eigen::Matrix2d::Identity() * (deviation * deviation);
  const Eigen::Matrix<double, 3, 2> gain = covariance_ * view.transpose() * total.inverse();
  const Eigen::Matrix3d left = Eigen::Matrix3d::Identity() - gain * view;
  state_ += gain * (foot.middle - expected(foot));
  covariance_ = left * covariance_ * left.transpose() + gain * gain.transpose() * (deviation * deviation);
  state_[2] = std::max(state_[2], 0.0);
  views_ = std::min(views_ + 1, most_views);
  const double radius = foot.radius + foot.lean[2] * (assumed_ - foot.height);
  radius_ += (radius - radius_) / views_;
  radius_lean_ += (foot.lean[2] - radius_lean_) / views_;
}

void FootFilter::drift(double distance) noexcept {
  covariance_(0, 0) += distance * distance;
  covariance_(1, 1) += distance * distance;
}

double FootFilter::radius() const noexcept {
  return std::max(radius_ + radius_lean_ * (state_[2] - assumed_), 0.0);
}

double FootFilter::deviation() const noexcept {
  return std::sqrt(std::max(covariance_(0, 0), covariance_(1, 1)));
}

}  // namespace flexrf::user
