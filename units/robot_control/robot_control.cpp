#include "units/robot_control/robot_control.hpp"

#include <algorithm>
#include <cmath>

#include "motion/pose_conversion.hpp"

namespace flexrf::user {
namespace {

// The arm has arrived when its joints are this near to their set-points: above the sensors' noise.
constexpr double arrived = 1e-3;  // rad or m

/// What is not a number equals nothing, and would be taken for another target in each cycle.
bool same_number(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

bool same(const Pose& a, const Pose& b) {
  return std::equal(a.position.begin(), a.position.end(), b.position.begin(), same_number) &&
         std::equal(a.orientation.begin(), a.orientation.end(), b.orientation.begin(), same_number);
}

}  // namespace

Status RobotControl::initialise() {
  motion_.use(arm->kinematic_chain());
  handled_.reset();
  held_ = false;
  tool_velocity_.setZero();
  last_cycle_ = Time{};
  return {};
}

void RobotControl::step(const Tick& tick) {
  const double elapsed = elapsed_in(tick);
  const auto state = arm->state();
  if (state) publish(*state);
  if (tick.motion_inhibited) tool_velocity_.setZero();
  if (tick.motion_inhibited || !motion_.is_seeded()) {
    // The first set-point is where the arm is, and a target from before the Start is not followed after it.
    if (state) {
      motion_.seed(state->position_map());
      kept_ = to_pose(forward_kinematics(arm->kinematic_chain(), motion_.set_point()));
    }
    if (const auto wanted = target.latest(); wanted && tick.motion_inhibited) handled_ = *wanted;
  }
  if (!motion_.is_seeded()) {
    hold("no joint positions from the arm yet");
    idle_ = true;
    return;
  }
  if (follow_velocity(state && !tick.motion_inhibited && !tick.stop_requested, elapsed)) {
    held_ = false;
  } else if (!state) {
    hold("the arm no longer tells its joint positions");
  } else if (tick.motion_inhibited) {
    hold("motion is inhibited");
  } else if (tick.stop_requested) {
    hold("stop requested");
  } else {
    follow_target();
  }
  command(elapsed);

  const bool settled =
      !state || (state->position_map() - motion_.set_point()).cwiseAbs().maxCoeff() < arrived;
  const auto wanted = target.latest();
  const bool more = wanted && !tick.stop_requested && !(handled_ && same(*wanted, *handled_));
  feedback.moving = motion_.is_moving() || !tool_velocity_.isZero(0);
  idle_ = !feedback.moving && settled && !more;
  feedback.set_point_map() = motion_.set_point();
}

void RobotControl::follow_target() noexcept {
  const auto wanted = target.latest();
  if (!wanted) {
    hold(wanted.reason() == NullReason::nothing_yet      ? "no target yet"
         : wanted.reason() == NullReason::not_registered ? ""  // it is moved by hand alone
                                                         : name_of(wanted.reason()));
    return;
  }
  if (held_) {
    held_ = false;
    feedback.set_holding({});
  }
  if (motion_.is_moving() || (handled_ && same(*wanted, *handled_))) return;
  // Whoever asked for more than can be reached goes on from what holds: the reason stays to be read.
  const bool goes_back = handled_ && same(*wanted, kept_);
  handled_ = *wanted;
  if (goes_back) return;
  const Status planned = motion_.move_to(*wanted, runtime.speed);
  feedback.set_holding(planned.cause());
  if (planned) {
    ++feedback.motions;
    kept_ = *wanted;
  } else {
    refuse(planned);
  }
  TargetAnswer said{};
  said.accepted = planned.is_ok();
  said.kept = kept_;
  said.set_reason(planned.cause());
  answer.publish(said);
}

void RobotControl::refuse(const Status& cause) noexcept {
  if (feedback.refusals++ == 0) feedback.set_first_refusal(cause.cause());
  log_warning(refusals_, name(), "{}", cause.cause());
}

/// While a velocity is wanted (and `allowed`), and until the tool is at rest again; false: there is nothing
/// to do.
bool RobotControl::follow_velocity(bool allowed, double elapsed) noexcept {
  Eigen::Vector3d wanted = Eigen::Vector3d::Zero();
  if (const auto asked = velocity.latest(); asked && allowed) wanted = asked->linear_map();
  if (!wanted.allFinite()) wanted.setZero();
  if (const double speed = wanted.norm(); speed > configuration.hand_speed)
    wanted *= configuration.hand_speed / speed;
  if (wanted.isZero(0) && tool_velocity_.isZero(0)) return false;
  // A target from before is not gone back to.
  if (const auto left_behind = target.latest()) handled_ = *left_behind;
  if (motion_.is_moving()) {
    motion_.stop();
    return true;
  }
  const Eigen::Vector3d change = wanted - tool_velocity_;
  const double most = configuration.hand_acceleration * elapsed;
  tool_velocity_ = change.norm() <= most ? wanted : tool_velocity_ + change.normalized() * most;
  const Status moved = motion_.shift(tool_velocity_ * elapsed, elapsed);
  if (!moved) tool_velocity_.setZero();
  feedback.set_holding(moved.cause());
  return true;
}

/// Since the cycle before, in s.
double RobotControl::elapsed_in(const Tick& tick) noexcept {
  const double elapsed = last_cycle_ == Time{} ? 0.0 : seconds(tick.nominal - last_cycle_);
  last_cycle_ = tick.nominal;
  return std::clamp(elapsed, 0.0, configuration.longest_advance);
}

void RobotControl::command(double elapsed) noexcept {
  motion_.advance(elapsed);
  JointPositions positions{};
  positions.position_map() = motion_.set_point();
  arm->command(positions);
}

void RobotControl::publish(const JointState& state) noexcept {
  pose.publish(to_pose(forward_kinematics(arm->kinematic_chain(), state.position_map())));
  joints.publish(state);
}

/// Comes to rest on the path and stays there; the target is looked at anew afterwards.
void RobotControl::hold(std::string_view reason) noexcept {
  if (motion_.is_moving()) handled_.reset();
  motion_.stop();
  held_ = true;
  feedback.set_holding(reason);
}

}  // namespace flexrf::user
