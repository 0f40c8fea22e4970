#include "hal/robot_arm/paced/joint_follower.hpp"

#include <algorithm>
#include <cmath>

#include "motion/joint_pace.hpp"

namespace flexrf {
namespace {

constexpr double same_place = 1e-12;  // rad or m

// The greatest velocity from which the joint comes to rest within `distance` when each cycle is slower by
// `change` than the one before, and the last ones by what is left.
double braked_within(double distance, double change, double cycle) noexcept {
  if (distance <= 0) return 0;
  const double way = distance / cycle;  // sum of the velocities of all cycles
  const double whole = std::floor(std::sqrt(0.25 + 2 * way / change) - 0.5);
  return (way + change * whole * (whole + 1) / 2) / (whole + 1);
}

}  // namespace

void JointFollower::begin(const KinematicChain& chain, double cycle) noexcept {
  *this = JointFollower{};
  chain_ = &chain;
  cycle_ = cycle;
}

void JointFollower::seed(const JointAngles& at) noexcept {
  set_point_ = wanted_ = wanted_before_ = at;
  velocity_ = {};
  brakes_ = false;
}

void JointFollower::command(const JointAngles& wanted) noexcept {
  for (std::size_t i = 0; i < chain_->joint_count; ++i) {
    wanted_[i] = std::clamp(wanted[i], chain_->joints[i].lower, chain_->joints[i].upper);
  }
}

const JointAngles& JointFollower::next() noexcept {
  for (std::size_t i = 0; i < chain_->joint_count; ++i) {
    const double change = chain_->joints[i].acceleration * cycle_;
    const double before = velocity_[i];
    const double pursued = brakes_ ? 0 : pursue(i);
    const double velocity = within_range(i, std::clamp(pursued, before - change, before + change));
    velocity_[i] = velocity;
    set_point_[i] += velocity * cycle_;
    // What is in reach is met exactly, whatever the additions made of it.
    if (!brakes_ && std::abs(set_point_[i] - wanted_[i]) < same_place) set_point_[i] = wanted_[i];
  }
  if (brakes_) wanted_ = set_point_;
  wanted_before_ = wanted_;
  return set_point_;
}

Restraint JointFollower::restraint() const noexcept {
  constexpr double cycles = 3;
  for (std::size_t i = 0; i < chain_->joint_count; ++i) {
    if (std::abs(wanted_[i] - set_point_[i]) > cycles * cycle_ * chain_->joints[i].velocity)
      return outpaced(i, wanted_[i], set_point_[i]);
  }
  return {};
}

// As fast as what is wanted moves, and beside that only so fast that it is not passed.
double JointFollower::pursue(std::size_t joint) const noexcept {
  const ChainJoint& limits = chain_->joints[joint];
  const double most = limits.velocity;
  const double ahead = std::clamp((wanted_[joint] - wanted_before_[joint]) / cycle_, -most, most);
  const double behind = wanted_[joint] - set_point_[joint] - ahead * cycle_;
  const double closing = braked_within(std::abs(behind), limits.acceleration * cycle_, cycle_);
  return std::clamp(ahead + std::copysign(closing, behind), -most, most);
}

// So slow that the joint can stop at the end of its range.
double JointFollower::within_range(std::size_t joint, double velocity) const noexcept {
  const ChainJoint& limits = chain_->joints[joint];
  const double change = limits.acceleration * cycle_;
  return std::clamp(velocity, -braked_within(set_point_[joint] - limits.lower, change, cycle_),
                    braked_within(limits.upper - set_point_[joint], change, cycle_));
}

}  // namespace flexrf
