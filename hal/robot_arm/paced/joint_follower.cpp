#include "hal/robot_arm/paced/joint_follower.hpp"

#include <algorithm>
#include <cmath>

#include "motion/joint_pace.hpp"

namespace flexrf {

void JointFollower::begin(const KinematicChain& chain, double cycle) noexcept {
  *this = JointFollower{};
  chain_ = &chain;
  cycle_ = cycle;
  for (std::size_t i = 0; i < chain.joint_count; ++i) {
    const ChainJoint& joint = chain.joints[i];
    joints_[i] = SetPointFollower{{.lowest = joint.lower,
                                   .highest = joint.upper,
                                   .velocity = joint.velocity,
                                   .acceleration = joint.acceleration}};
  }
}

void JointFollower::seed(const JointAngles& at) noexcept {
  set_point_ = at;
  for (std::size_t i = 0; i < joints_.size(); ++i) joints_[i].seed(at[i]);
  brakes_ = false;
}

void JointFollower::command(const JointAngles& wanted) noexcept {
  if (brakes_) return;
  for (std::size_t i = 0; i < chain_->joint_count; ++i) joints_[i].command(wanted[i]);
}

void JointFollower::brake() noexcept {
  brakes_ = true;
  for (SetPointFollower& joint : joints()) joint.brake();
}

void JointFollower::stand() noexcept {
  for (SetPointFollower& joint : joints()) joint.stand();
}

const JointAngles& JointFollower::next() noexcept {
  for (std::size_t i = 0; i < chain_->joint_count; ++i) set_point_[i] = joints_[i].next(cycle_);
  return set_point_;
}

bool JointFollower::is_at_rest() const noexcept {
  return std::all_of(joints_.begin(), joints_.end(),
                     [](const SetPointFollower& joint) { return joint.is_at_rest(); });
}

Restraint JointFollower::restraint() const noexcept {
  constexpr double cycles = 3;
  for (std::size_t i = 0; i < chain_->joint_count; ++i) {
    const SetPointFollower& joint = joints_[i];
    if (std::abs(joint.wanted() - joint.set_point()) > cycles * cycle_ * chain_->joints[i].velocity)
      return outpaced(i, joint.wanted(), joint.set_point());
  }
  return {};
}

}  // namespace flexrf
