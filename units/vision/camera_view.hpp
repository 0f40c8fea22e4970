// CameraView: where a camera on the arm's tool was when it took a picture, and what that makes of its pixels.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "base/status.hpp"
#include "base/time.hpp"
#include "runtime/blackboard/ports.hpp"
#include "types/camera_model.hpp"
#include "types/pose.hpp"

namespace flexrf::user {

/// Says what is wrong with a camera of the tables; ok: it can be used.
Status check_camera(const CameraModel& camera) noexcept;

/// A pinhole camera in the robot's frame. Positions in m, pixels as CameraModel counts them. Any thread.
class CameraView {
 public:
  CameraView() = default;
  /// `tool`: the tool's pose in the robot's frame at mid-exposure.
  CameraView(const CameraModel& camera, const Pose& tool) noexcept;

  const Eigen::Vector3d& position() const noexcept { return position_; }

  /// Where the pixel's ray meets the horizontal plane at height `z`. False, and `point` as it was, where it
  /// does not: the ray is level or rises, or the camera lies below the plane.
  bool to_plane(double column, double row, double z, Eigen::Vector2d& point) const noexcept;

  /// The pixel that shows the point; it may lie outside of the picture. False, and `pixel` as it was, where
  /// the point is not at least 1 mm ahead of the camera.
  bool to_picture(const Eigen::Vector3d& point, Eigen::Vector2d& pixel) const noexcept;

  /// Pixels that one metre across the line of sight takes at the point; 0: it is not ahead of the camera.
  double pixels_per_metre(const Eigen::Vector3d& point) const noexcept;

 private:
  Eigen::Matrix3d axes_ = Eigen::Matrix3d::Identity();  // of the camera, in the robot's frame
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero();
  Eigen::Vector2d principal_ = Eigen::Vector2d::Zero();
  double focal_ = 1;
};

/// The tool's pose at `time`, between the two that the slot's history has beside it: positions linearly, the
/// orientation by the shortest turn. A picture may be newer than the newest pose by as much as the last two
/// are apart, one cycle of the arm: so long the motion goes on as between them, which at an acceleration a is
/// wrong by a * cycle^2. Otherwise the reason why there is none: `too_old`, `no_longer_kept`,
/// `nothing_yet` before the arm's second pose, or the slot's own.
NullReason tool_pose_at(const Input<Pose>& poses, Time time, Pose& pose) noexcept;

/// Whether the operator is to be told that tool_pose_at() found no pose, by its reason. Not where the picture
/// is older than the arm's second pose, as the first pictures after a start are: the next one has its pose.
bool lacks_poses(NullReason reason, const Input<Pose>& poses) noexcept;

}  // namespace flexrf::user
