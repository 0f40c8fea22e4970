#include "units/robot_control/jog_steps.hpp"

#include <limits>

namespace flexrf::user {
namespace {

// A step's goal does not grow old.
constexpr double for_ever = std::numeric_limits<double>::infinity();  // s

}  // namespace

void JogSteps::ToolStep::advance(double elapsed, bool goes_on) noexcept {
  if (goes_on) {
    [[maybe_unused]] const Status taken = stream.aim(goal);  // a reachable pose
  } else {
    stream.let_go();
  }
  stream.advance(elapsed);
}

void JogSteps::use(const KinematicChain& chain, double tool_speed) noexcept {
  chain_ = &chain;
  tool_ = ToolStep{};
  tool_.stream.use(chain, {}, for_ever);
  joint_.use(chain, tool_speed);
  of_joint_ = false;
  refusal_ = {};
  cancel();
}

void JogSteps::ask(const StepWish& wish, const Speeds& speeds) noexcept {
  if (is_wanted()) return;
  asked_ = wish;
  speeds_ = speeds;
}

void JogSteps::cancel() noexcept {
  asked_.reset();
  is_under_way_ = false;
}

void JogSteps::begin(const JointVector& set_point) noexcept {
  of_joint_ = asked_ && asked_->of_joint();
  leading().begin(set_point);
}

void JogSteps::advance(double elapsed, bool goes_on) noexcept {
  if (!goes_on) cancel();
  if (asked_ && !is_under_way_ && is_at_rest()) {
    // The joints may be another part's to lead than in the step before.
    const JointVector from = set_point();
    of_joint_ = asked_->of_joint();
    leading().begin(from);
    if (of_joint_) {
      const std::size_t joint = asked_->joint();
      const double fastest = joint < chain_->joint_count ? chain_->joints[joint].velocity : 0;
      refusal_ = joint_.begin_step(from, joint, asked_->way, speeds_.joint_share * fastest);
    } else {
      refusal_ = begin_tool_step(from);
    }
    is_under_way_ = refusal_.is_ok();
    asked_.reset();
  }
  if (of_joint_ && !is_under_way_) joint_.end_step();
  leading().advance(elapsed, is_under_way_);
  if (!is_under_way_ || !is_at_rest()) return;
  if (is_finished()) {
    is_under_way_ = false;
  } else if (const Restraint found = restraint(); found.reason != nullptr) {
    is_under_way_ = false;
    refusal_ = Status::error(StatusCode::out_of_range, "the step ended early: %s", found.reason);
  }
}

const MotionSource& JogSteps::leading() const noexcept {
  if (of_joint_) return joint_;
  return tool_;
}

MotionSource& JogSteps::leading() noexcept {
  if (of_joint_) return joint_;
  return tool_;
}

Status JogSteps::begin_tool_step(const JointVector& set_point) noexcept {
  tool_.stream.use(*chain_, speeds_.tool, for_ever);
  tool_.stream.seed(set_point);
  tool_.goal = forward_kinematics(*chain_, set_point);
  if (asked_->axis < 3) {
    tool_.goal.translation()[asked_->axis] += asked_->way;
  } else {
    tool_.goal.linear() =
        Eigen::AngleAxisd(asked_->way, Eigen::Vector3d::Unit(asked_->axis - 3)).toRotationMatrix() *
        tool_.goal.linear();
  }
  const InverseResult end = inverse_kinematics(*chain_, tool_.goal, set_point);
  if (end.outcome == InverseOutcome::converged) return {};
  return Status::error(StatusCode::out_of_range, "the step is refused: its end is %s", to_text(end.outcome));
}

bool JogSteps::is_finished() const noexcept {
  return of_joint_ ? !joint_.is_stepping() : tool_.stream.has_arrived();
}

}  // namespace flexrf::user
