#include "motion/pose_stream.hpp"

#include <algorithm>
#include <cmath>

namespace flexrf {
namespace {

constexpr double near_by = 1e-8;  // m or rad
constexpr double slowest = 0.01;  // of the limits of velocity

}  // namespace

void PoseStream::use(const KinematicChain& chain, const StreamLimits& limits, double max_age) noexcept {
  guarded_.use(chain, limits);
  max_age_ = max_age;
  target_.reset();
}

void PoseStream::seed(const JointVector& joints) noexcept {
  guarded_.seed(joints);
  target_.reset();
}

Status PoseStream::aim(const Eigen::Isometry3d& target, double age, std::uint32_t way, double part) noexcept {
  if (!is_pose(target) || !std::isfinite(age) || !std::isfinite(part))
    return Status::error(StatusCode::invalid_argument, "the target is not a pose");
  target_ = target;
  age_ = age;
  way_ = way;
  part_ = std::clamp(part, slowest, 1.0);
  return {};
}

void PoseStream::advance(double elapsed) noexcept {
  if (!(elapsed > 0)) return;
  age_ += elapsed;
  if (is_stale()) return guarded_.brake(elapsed);
  guarded_.advance(elapsed, [this](PoseMotion& motion, double part, double time) {
    motion.advance(*target_, way_, part * part_, time);
  });
}

bool PoseStream::has_arrived() const noexcept {
  if (!target_ || !is_at_rest()) return false;
  const Eigen::Isometry3d pose = guarded_.motion().pose();
  const Eigen::Quaterniond turn(target_->linear() * pose.linear().transpose());
  return (target_->translation() - pose.translation()).norm() < near_by &&
         rotation_vector(turn).norm() < near_by;
}

bool is_pose(const Eigen::Isometry3d& pose) noexcept {
  constexpr double farthest = 1e3;  // m: squares of coordinates must not overflow
  const Eigen::Matrix3d& rotation = pose.linear();
  return pose.matrix().allFinite() && pose.translation().cwiseAbs().maxCoeff() <= farthest &&
         (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-6 &&
         rotation.determinant() > 0;
}

}  // namespace flexrf
