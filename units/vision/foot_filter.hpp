// FootFilter: where an obstacle stands and how high it is, from views of different places (Kalman 1960).
#pragma once

#include <Eigen/Core>

namespace flexrf::user {

/// A disc that holds a foot, as one view tells it for an assumed height.
struct SeenFoot {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();  ///< m
  double radius = 0;                                 ///< m
  double height = 0;                                 ///< m, that was assumed
  /// By which middle (x, y) and radius change when it is thought to be 1 m higher.
  Eigen::Vector3d lean = Eigen::Vector3d::Zero();
};

/// One view tells a foot's near side, and the far side by an assumed height only. Its error points away from
/// the camera, so that views from two sides tell the height. One that a height below 0 would explain best has
/// none.
class FootFilter {
 public:
  /// `deviation` (m): of a view's middle, beside the height.
  void begin(const SeenFoot& foot, double deviation) noexcept;
  /// A view from about the same place as the last one has its errors, and counts only where it shows that the
  /// obstacle was moved.
  void correct(const SeenFoot& foot, double deviation) noexcept;
  /// It may have been moved by so much (m, standard deviation).
  void drift(double distance) noexcept;

  Eigen::Vector2d middle() const noexcept { return state_.head<2>(); }
  double height() const noexcept { return state_[2]; }
  double radius() const noexcept;
  double deviation() const noexcept;  ///< m, of each of x and y

 private:
  Eigen::Vector2d expected(const SeenFoot& foot) const noexcept;
  void take(const SeenFoot& foot, double deviation) noexcept;

  Eigen::Vector3d state_ = Eigen::Vector3d::Zero();  // x, y, height
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Identity();
  // Of the views, for the assumed height.
  double radius_ = 0;
  double radius_lean_ = 0;
  double assumed_ = 0;
  double views_ = 0;
  Eigen::Vector3d last_lean_ = Eigen::Vector3d::Zero();
};

}  // namespace flexrf::user
