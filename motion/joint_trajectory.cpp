#include "motion/joint_trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flexrf {
namespace {

// Shorter motions are no motion: far below any encoder's step.
constexpr double shortest_motion = 1e-9;  // rad or m

bool usable(double limit) {
  return std::isfinite(limit) && limit > 0;
}

}  // namespace

bool JointTrajectory::plan(const KinematicChain& chain, const JointVector& start, const JointVector& target,
                           double speed) {
  start_ = start;
  target_ = start;
  profile_ = {};
  profile_start_ = 0;
  stopped_ = false;
  if (!start.allFinite() || !target.allFinite() || !(speed > 0) || !(speed <= 1)) return false;

  constexpr double unlimited = std::numeric_limits<double>::infinity();
  MotionLimits limits{unlimited, unlimited, unlimited};
  double longest = 0;
  for (std::size_t i = 0; i < chain.joint_count; ++i) {
    const ChainJoint& joint = chain.joints[i];
    if (!usable(joint.velocity) || !usable(joint.acceleration) || !usable(joint.jerk)) return false;
    const auto index = static_cast<Eigen::Index>(i);
    const double distance = std::abs(target[index] - start[index]);
    longest = std::max(longest, distance);
    if (distance == 0) continue;
    limits.velocity = std::min(limits.velocity, speed * joint.velocity / distance);
    limits.acceleration = std::min(limits.acceleration, speed * joint.acceleration / distance);
    limits.jerk = std::min(limits.jerk, speed * joint.jerk / distance);
  }
  target_ = target;
  if (longest < shortest_motion) return true;
  limits_ = limits;
  profile_ = JerkProfile::rest_to_rest(1.0, limits_);
  return true;
}

void JointTrajectory::stop(double time) {
  if (!(time < end_time()) || stopped_) return;
  profile_ = JerkProfile::stop(profile_.at(time - profile_start_), limits_);
  profile_start_ = std::max(0.0, time);
  stopped_ = true;
}

JointSample JointTrajectory::at(double time) const {
  JointSample sample;
  const bool arrived = !(time < end_time());
  if (arrived && !stopped_) {
    sample.position = target_;
    return sample;
  }
  const MotionState path = arrived ? profile_.end() : profile_.at(time - profile_start_);
  const JointVector line = target_ - start_;
  sample.position = start_ + std::clamp(path.position, 0.0, 1.0) * line;
  sample.velocity = path.velocity * line;
  sample.acceleration = path.acceleration * line;
  return sample;
}

}  // namespace flexrf
