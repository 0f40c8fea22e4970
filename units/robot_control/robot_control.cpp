#include "units/robot_control/robot_control.hpp"

#include <algorithm>

#include "hal/interfaces/robot_arm/pose_conversion.hpp"

namespace flexrf {
namespace {

// The arm has arrived when its joints are this near to their set-points: above the sensors' noise.
constexpr double arrived = 1e-3;  // rad

bool same(const Pose& a, const Pose& b) {
  return a.position == b.position && a.orientation == b.orientation;
}

}  // namespace

Status RobotControl::initialise() {
  motion_.use(arm->kinematic_chain());
  handled_.reset();
  held_ = false;
  last_cycle_ = Time{};
  return {};
}

void RobotControl::step(const Tick& tick) {
  const auto state = arm->state();
  if (state) publish(*state);
  if (tick.motion_inhibited || !motion_.is_seeded()) {
    // The first set-point is where the arm is, and a target from before the Start is not followed after it.
    if (state) motion_.seed(state->position_map());
    if (const auto wanted = target.latest(); wanted && tick.motion_inhibited) handled_ = *wanted;
  }
  if (!motion_.is_seeded()) {
    hold("no joint positions from the arm yet");
    idle_ = true;
    return;
  }
  if (!state) {
    hold("the arm no longer tells its joint positions");
  } else if (tick.motion_inhibited) {
    hold("motion is inhibited");
  } else if (tick.stop_requested) {
    hold("stop requested");
  } else {
    follow_target();
  }
  command(tick);

  const bool settled =
      !state || (state->position_map() - motion_.set_point()).cwiseAbs().maxCoeff() < arrived;
  const auto wanted = target.latest();
  const bool more = wanted && !tick.stop_requested && !(handled_ && same(*wanted, *handled_));
  idle_ = !motion_.is_moving() && settled && !more;
  feedback.moving = motion_.is_moving();
  feedback.set_point_map() = motion_.set_point();
}

void RobotControl::follow_target() noexcept {
  const auto wanted = target.latest();
  if (!wanted) {
    hold(wanted.reason() == NullReason::nothing_yet ? "no target yet" : name_of(wanted.reason()));
    return;
  }
  if (held_) {
    held_ = false;
    feedback.set_holding({});
  }
  if (motion_.is_moving() || (handled_ && same(*wanted, *handled_))) return;
  handled_ = *wanted;
  const Status planned = motion_.move_to(*wanted, runtime.speed);
  feedback.set_holding(planned.cause());
  if (planned) ++feedback.motions;
}

void RobotControl::command(const Tick& tick) noexcept {
  const double elapsed = last_cycle_ == Time{} ? 0.0 : seconds(tick.nominal - last_cycle_);
  last_cycle_ = tick.nominal;
  motion_.advance(std::clamp(elapsed, 0.0, configuration.longest_advance));
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

}  // namespace flexrf
