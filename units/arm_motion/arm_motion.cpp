#include "units/arm_motion/arm_motion.hpp"

#include "motion/pose_conversion.hpp"

namespace flexrf {

void ArmMotion::use(const KinematicChain& chain) noexcept {
  chain_ = &chain;
  seeded_ = false;
  moving_ = false;
}

void ArmMotion::seed(const JointVector& actual) noexcept {
  set_point_ = within_limits(*chain_, actual);
  seeded_ = true;
  moving_ = false;
}

Status ArmMotion::move_to(const Pose& target, double speed) noexcept {
  const InverseResult goal = inverse_kinematics(*chain_, to_isometry(target), set_point_);
  if (goal.outcome != InverseOutcome::converged) {
    return Status::error(StatusCode::out_of_range, "target (%.3f, %.3f, %.3f) m refused: %s, %.1f mm short",
                         target.position[0], target.position[1], target.position[2], to_text(goal.outcome),
                         goal.position_error * 1e3);
  }
  if (!trajectory_.plan(*chain_, set_point_, goal.joints, speed)) {
    return Status::error(StatusCode::invalid_argument,
                         "no trajectory: speed or a joint's limits make no sense");
  }
  time_ = 0;
  moving_ = trajectory_.end_time() > 0;
  return {};
}

void ArmMotion::stop() noexcept {
  if (moving_) trajectory_.stop(time_);
}

void ArmMotion::advance(double elapsed) noexcept {
  if (!moving_) return;
  time_ += elapsed;
  set_point_ = trajectory_.at(time_).position;
  moving_ = time_ < trajectory_.end_time();
}

}  // namespace flexrf
