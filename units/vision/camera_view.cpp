#include "units/vision/camera_view.hpp"

#include <array>
#include <cmath>

#include "motion/pose_conversion.hpp"

namespace flexrf::user {
namespace {

constexpr double least_ahead = 1e-3;  // m ahead of the camera
constexpr Duration beside_a_picture = std::chrono::milliseconds(50);

}  // namespace

Status check_camera(const CameraModel& camera) noexcept {
  if (!(camera.focal_length >= 1) || !std::isfinite(camera.focal_length))
    return Status::error(StatusCode::invalid_argument,
                         "the camera's focal length is %g px: give the camera's own in 'camera'",
                         camera.focal_length);
  if (camera.width != 640 || camera.height != 480)
    return Status::error(StatusCode::invalid_argument,
                         "the camera gives %u x %u pixels: these units take 640 x 480", camera.width,
                         camera.height);
  if (!camera.principal_point_map().allFinite() || !camera.mount.position_map().allFinite() ||
      !camera.mount.orientation_map().allFinite())
    return Status::error(StatusCode::invalid_argument, "'camera' has numbers that are not finite");
  return {};
}

CameraView::CameraView(const CameraModel& camera, const Pose& tool) noexcept
    : principal_(camera.principal_point_map()), focal_(camera.focal_length) {
  const Eigen::Isometry3d frame = to_isometry(tool) * to_isometry(camera.mount);
  axes_ = frame.linear();
  position_ = frame.translation();
}

bool CameraView::to_plane(double column, double row, double z, Eigen::Vector2d& point) const noexcept {
  const Eigen::Vector3d ahead((column - principal_.x()) / focal_, (row - principal_.y()) / focal_, 1.0);
  const Eigen::Vector3d ray = axes_ * ahead;
  const double above = position_.z() - z;
  if (!(above > least_ahead) || !(ray.z() < -1e-6)) return false;
  point = position_.head<2>() - ray.head<2>() * (above / ray.z());
  return true;
}

bool CameraView::to_picture(const Eigen::Vector3d& point, Eigen::Vector2d& pixel) const noexcept {
  const Eigen::Vector3d seen = axes_.transpose() * (point - position_);
  if (!(seen.z() >= least_ahead)) return false;
  pixel = principal_ + seen.head<2>() * (focal_ / seen.z());
  return true;
}

double CameraView::pixels_per_metre(const Eigen::Vector3d& point) const noexcept {
  const double ahead = axes_.col(2).dot(point - position_);
  return ahead >= least_ahead ? focal_ / ahead : 0.0;
}

NullReason tool_pose_at(const Input<Pose>& poses, Time time, Pose& pose) noexcept {
  // A control cycle of 2 ms and more has all of its poses in here.
  std::array<ItemHeader, 56> headers{};
  std::array<Pose, 56> values{};
  const std::size_t count =
      poses.between(time - beside_a_picture, time + beside_a_picture, headers, values.data());
  std::size_t after = 0;
  while (after < count && headers[after].sampled_at < time) ++after;
  if (after < count && headers[after].sampled_at == time) {
    pose = values[after];
    return NullReason::none;
  }
  if (after == 0) {
    const NullReason reason = poses.at(time, pose);
    return reason == NullReason::none ? NullReason::too_old : reason;
  }
  if (after == count) --after;  // ahead of the newest: on from the last two
  if (after == 0) return headers[0].sequence == 1 ? NullReason::nothing_yet : NullReason::too_old;
  const Time before = headers[after - 1].sampled_at;
  const Duration apart = headers[after].sampled_at - before;
  if (apart <= Duration{} || time - before > 2 * apart) return NullReason::too_old;
  const double share = seconds(time - before) / seconds(apart);
  const Eigen::Isometry3d from = to_isometry(values[after - 1]);
  const Eigen::Isometry3d to = to_isometry(values[after]);
  Eigen::Isometry3d between = Eigen::Isometry3d::Identity();
  between.translation() = from.translation() + share * (to.translation() - from.translation());
  between.linear() =
      Eigen::Quaterniond(from.linear()).slerp(share, Eigen::Quaterniond(to.linear())).toRotationMatrix();
  pose = to_pose(between);
  return NullReason::none;
}

bool lacks_poses(NullReason reason, const Input<Pose>& poses) noexcept {
  if (reason != NullReason::nothing_yet) return reason != NullReason::none;
  Pose newest{};
  return poses.at(Time{Duration::max()}, newest) != NullReason::none;
}

}  // namespace flexrf::user
