#include "hal/robot_arm/simulated/arm_model.hpp"

#include <algorithm>
#include <cmath>

namespace flexrf {
namespace {

constexpr Duration step_time = std::chrono::milliseconds(1);
constexpr double step_seconds = 1e-3;
constexpr Duration longest_gap = std::chrono::seconds(1);
// Slower than this a servo stands still: 1e-9 rad/s is a turn in 200 years. In m/s of one that slides.
constexpr double rest_velocity = 1e-9;

}  // namespace

void ArmModel::reset(const KinematicChain& chain, double lag) {
  *this = ArmModel();
  chain_ = &chain;
  lag_ = lag;
  position_ = home_position(chain);
  command_ = position_;
}

void ArmModel::restart(const KinematicChain& chain, double lag) {
  const bool stands_somewhere = chain_ == &chain;
  const JointVector where = position();
  reset(chain, lag);
  if (stands_somewhere) position_ = command_ = within_limits(chain, where);
}

void ArmModel::follow(const JointVector& positions) {
  holding_ = false;
  command_ = within_limits(*chain_, positions);
}

void ArmModel::hold() {
  holding_ = true;
}

void ArmModel::stick(int joint) {
  stuck_ = joint;
}

void ArmModel::advance(Time now) {
  if (now_ == Time{} || now - now_ > longest_gap) {
    const Duration moved = now_ == Time{} ? Duration{} : longest_gap;
    now_ = now;
    stepped_until_ = now - moved;
  }
  now_ = std::max(now_, now);
  while (stepped_until_ + step_time <= now_) {
    stepped_until_ += step_time;
    step();
  }
}

bool ArmModel::is_at_rest() const {
  return velocity_.isZero(0);
}

double ArmModel::approach_velocity(double distance, const ChainJoint& joint) const {
  // Far off, the velocity that can just be braked; near, the servo's exponential. They meet where the
  // exponential begins to brake with less than the joint's acceleration.
  const double lag = std::max(lag_, 2 * step_seconds);
  const double near = joint.acceleration * lag * lag;
  if (distance <= near) return distance / lag;
  return std::sqrt(2 * joint.acceleration * (distance - near / 2));
}

void ArmModel::step() {
  for (std::size_t i = 0; i < chain_->joint_count; ++i) {
    const auto index = static_cast<Eigen::Index>(i);
    const ChainJoint& joint = chain_->joints[i];
    double& position = position_[index];
    double& velocity = velocity_[index];
    if (static_cast<int>(i) == stuck_) {
      velocity = 0;
      continue;
    }
    double wanted = 0;
    if (!holding_) {
      const double difference = command_[index] - position;
      if (difference == 0 && velocity == 0) continue;
      wanted =
          std::copysign(std::min(joint.velocity, approach_velocity(std::abs(difference), joint)), difference);
    }
    const double change = joint.acceleration * step_seconds;
    velocity += std::clamp(wanted - velocity, -change, change);
    if (std::abs(velocity) < rest_velocity) {
      velocity = 0;
      continue;
    }
    position += velocity * step_seconds;
    if (position < joint.lower || position > joint.upper) {  // the mechanical stop
      position = std::clamp(position, joint.lower, joint.upper);
      velocity = 0;
    }
  }
  if (holding_) command_ = position_;
}

}  // namespace flexrf
