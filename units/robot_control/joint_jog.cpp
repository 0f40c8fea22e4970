#include "units/robot_control/joint_jog.hpp"

#include <algorithm>
#include <cmath>

namespace flexrf::user {
namespace {

// Part of a joint's acceleration and jerk: a person is near, and a hand does not hurry.
constexpr double gentle = 0.25;
// The tool's speed is kept a little below its limit: levers change while several joints move.
constexpr double margin = 0.95;
// A joint is where it was led to when it is this near.
constexpr double at_goal = 1e-9;  // rad or m

constexpr const char* tool_too_fast = "the tool would be too fast, so the joints are slower";
constexpr const char* at_its_end = "a joint is at the end of its range";
constexpr const char* joint_too_fast = "a joint is asked to be faster than it may";

Eigen::Index index_of(std::size_t joint) {
  return static_cast<Eigen::Index>(joint);
}

}  // namespace

void JointJog::use(const KinematicChain& chain, double tool_speed) noexcept {
  *this = JointJog{};
  chain_ = &chain;
  tool_speed_ = tool_speed;
}

Status JointJog::want(const JointVector& rates) noexcept {
  wanted_.setZero();
  if (!rates.allFinite())
    return Status::error(StatusCode::invalid_argument, "a joint's velocity wanted is not a number");
  const auto count = index_of(chain_->joint_count);
  wanted_.head(count) = rates.head(count);
  return {};
}

Status JointJog::begin_step(const JointVector& set_point, std::size_t joint, double way,
                            double rate) noexcept {
  if (joint >= chain_->joint_count)
    return Status::error(StatusCode::invalid_argument, "the arm has %zu joints, and no joint %zu",
                         chain_->joint_count, joint + 1);
  const double goal = set_point[index_of(joint)] + way;
  const ChainJoint& one = chain_->joints[joint];
  if (!(goal >= one.lower && goal <= one.upper))
    return Status::error(StatusCode::out_of_range,
                         "the step would take joint %zu to %.4f, beyond its range of %.4f to %.4f", joint + 1,
                         goal, one.lower, one.upper);
  begin(set_point);
  step_ = joint;
  step_goal_ = goal;
  step_rate_ = rate;
  return {};
}

void JointJog::begin(const JointVector& set_point) noexcept {
  set_point_ = set_point;
  for (std::size_t i = 0; i < axes_.size(); ++i) axes_[i] = {.position = set_point[index_of(i)]};
  step_ = max_joints;
  restraint_ = {};
}

void JointJog::advance(double elapsed, bool goes_on) noexcept {
  restraint_ = {};
  read_rates(goes_on);
  keep_to_tool_speed();
  // Where levers grew faster than joints brake, time goes slower for them.
  const Eigen::Vector3d before = forward_kinematics(*chain_, set_point_).translation();
  double time = elapsed;
  for (int halvings = 0; halvings < 4; ++halvings, time /= 2) {
    const Axes next = moved_on(time);
    JointVector positions = set_point_;
    for (std::size_t i = 0; i < chain_->joint_count; ++i)
      positions[index_of(i)] = std::clamp(next[i].position, chain_->joints[i].lower, chain_->joints[i].upper);
    const double moved = (forward_kinematics(*chain_, positions).translation() - before).norm();
    if (moved > tool_speed_ * elapsed) continue;
    axes_ = next;
    set_point_ = positions;
    break;
  }
  if (is_stepping() && is_at_rest() && std::abs(axes_[step_].position - step_goal_) < at_goal) end_step();
}

bool JointJog::is_at_rest() const noexcept {
  return std::all_of(axes_.begin(), axes_.end(),
                     [](const MotionState& axis) { return axis.velocity == 0 && axis.acceleration == 0; });
}

void JointJog::read_rates(bool goes_on) noexcept {
  rates_.setZero();
  if (!goes_on) return;
  if (is_stepping()) {
    const double way = step_goal_ - axes_[step_].position;
    rates_[index_of(step_)] = std::copysign(step_rate_, way);
  } else {
    rates_ = wanted_;
  }
  for (std::size_t i = 0; i < chain_->joint_count; ++i) {
    double& rate = rates_[index_of(i)];
    const ChainJoint& joint = chain_->joints[i];
    if (std::abs(rate) > joint.velocity) {
      restraint_ = {joint_too_fast, std::abs(rate), joint.velocity};
      rate = std::copysign(joint.velocity, rate);
    }
    const double room = rate > 0 ? joint.upper - axes_[i].position : axes_[i].position - joint.lower;
    const bool at_end = rate != 0 && room < at_goal;
    if (at_end && !is_stepping()) {
      restraint_ = {.reason = at_its_end};
      rate = 0;
    }
  }
}

void JointJog::keep_to_tool_speed() noexcept {
  const JacobianMatrix jacobian = geometric_jacobian(*chain_, set_point_);
  double asked = 0;
  for (std::size_t i = 0; i < chain_->joint_count; ++i)
    asked += jacobian.col(index_of(i)).head<3>().norm() * std::abs(rates_[index_of(i)]);
  if (asked <= margin * tool_speed_) return;
  rates_ *= margin * tool_speed_ / asked;
  if (restraint_.reason == nullptr) restraint_ = {tool_too_fast, asked, margin * tool_speed_};
}

JointJog::Axes JointJog::moved_on(double elapsed) const noexcept {
  Axes next = axes_;
  for (std::size_t i = 0; i < chain_->joint_count; ++i) {
    const ChainJoint& joint = chain_->joints[i];
    const double rate = std::abs(rates_[index_of(i)]);
    const MotionLimits limits{rate, gentle * joint.acceleration, gentle * joint.jerk};
    next[i] = rate > 0 ? towards_position(axes_[i], goal_of(i), limits, elapsed)
                       : JerkProfile::stop(axes_[i], limits).at(elapsed);
  }
  return next;
}

double JointJog::goal_of(std::size_t joint) const noexcept {
  if (joint == step_) return step_goal_;
  return rates_[index_of(joint)] > 0 ? chain_->joints[joint].upper : chain_->joints[joint].lower;
}

}  // namespace flexrf::user
