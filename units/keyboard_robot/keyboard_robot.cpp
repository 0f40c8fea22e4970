#include "units/keyboard_robot/keyboard_robot.hpp"

#include <algorithm>
#include <utility>

#include "motion/pose_conversion.hpp"
#include "units/arm_motion/key_motion.hpp"

namespace flexrf::user {
namespace {

// The arm has arrived when its joints are this near to their set-points: above the sensors' noise.
constexpr double arrived = 1e-3;  // rad or m
// A later cycle delays the motion, rather than have the arm jump to catch up.
constexpr double longest_advance = 0.02;  // s
// Keys that turn the target are jog's.
constexpr double no_turn = 0;
// However fast keys come, a step ends.
constexpr int most_keys_per_step = 64;

}  // namespace

Status KeyboardRobot::initialise() {
  motion_.use(arm->kinematic_chain());
  moved_ = is_to_be_seeded_ = was_inhibited_ = false;
  return {};
}

void KeyboardRobot::step(const Tick& tick) {
  const auto state = arm->state();
  const bool follows = !tick.motion_inhibited && arm->is_ready();
  is_to_be_seeded_ = is_to_be_seeded_ || !motion_.is_seeded() || !follows || !state;
  // It stops by itself, and not where a motion of before would have it.
  if (!follows && motion_.is_seeded()) motion_.seed(motion_.set_point());
  if (!state) {
    motion_.stop();
  } else {
    const Pose actual = to_pose(forward_kinematics(arm->kinematic_chain(), state->position_map()));
    pose.publish(actual, arm->measured_at());
    // The set-point is where the arm is, also after a time in which it did not follow or was not heard.
    if (is_to_be_seeded_ && !motion_.is_moving()) {
      motion_.seed(state->position_map());
      target_ = kept_ = actual;
      is_to_be_seeded_ = !follows;
      moved_ = false;
    }
    if (follows && tick.stop_requested) motion_.stop();
  }
  // Keys carry no time: one that is read in the first cycle after a Start may have been pressed before it.
  const bool was_inhibited = std::exchange(was_inhibited_, tick.motion_inhibited);
  if (state && follows && !was_inhibited && !tick.stop_requested) {
    follow_keys();
  } else {
    for (int n = 0; n < most_keys_per_step && keyboard->read(); ++n)
      continue;  // not kept for when the arm may move, or is heard again
  }
  if (!motion_.is_seeded()) return;
  motion_.advance(std::min(seconds(tick.elapsed), longest_advance));
  JointPositions set_points{};
  set_points.position_map() = motion_.set_point();
  arm->command(set_points);
  idle_ = !motion_.is_moving() && !moved_ &&
          (!state || (state->position_map() - motion_.set_point()).cwiseAbs().maxCoeff() < arrived);
}

void KeyboardRobot::follow_keys() noexcept {
  for (int n = 0; n < most_keys_per_step; ++n) {
    const auto key = keyboard->read();
    if (!key) break;
    if (!move_by_key(target_, *key, runtime.step, no_turn)) continue;
    moved_ = true;
    ++feedback.presses;
  }
  if (!moved_ || motion_.is_moving()) return;
  moved_ = false;
  const Status moved = motion_.move_to(target_, 1.0);
  feedback.set_refusal(moved.cause());
  if (moved) {
    kept_ = target_;
    return;
  }
  // Further presses must not lead ever farther out of reach.
  target_ = kept_;
  ++feedback.refusals;
  log_warning(refusals_, name(), "{}", moved.cause());
}

}  // namespace flexrf::user
