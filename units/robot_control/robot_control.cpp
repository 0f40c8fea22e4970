#include "units/robot_control/robot_control.hpp"

#include <algorithm>
#include <cstdio>

#include "motion/pose_conversion.hpp"
#include "units/robot_control/jog_wish.hpp"
#include "units/robot_control/mode_rules.hpp"

namespace flexrf::user {
namespace {

// The arm has arrived when its joints are this near to their set-points: above the sensors' noise.
constexpr double arrived = 1e-3;  // rad or m

}  // namespace

Status RobotControl::initialise() {
  const KinematicChain& chain = arm->kinematic_chain();
  const double tool_speed = std::min(configuration.hand_speed, manual_speed);
  steps_.use(chain, tool_speed);
  tool_jog_.use(chain, hand_limits());
  joint_jog_.use(chain, tool_speed);
  servo_.use(chain, servo_limits(), configuration.servo_age);
  targets_.use(chain);
  active_ = nullptr;
  refused_wish_ = {};
  refused_by_mode_ = nullptr;
  has_ignored_target_ = false;
  followed_servo_ = false;
  last_cycle_ = Time{};
  is_seeded_ = is_to_be_seeded_ = false;
  stands_still_ = true;
  return {};
}

Status RobotControl::accept(const Runtime& proposed) {
  if (proposed.mode == runtime.mode || stands_still_) return {};
  return Status::error(
      StatusCode::not_permitted,
      "the mode is changed at standstill only, and the arm moves: wait until it rests, or stop it");
}

void RobotControl::step(const Tick& tick) {
  const double elapsed = elapsed_in(tick);
  const auto state = arm->state();
  if (state) publish(*state);
  const auto wanted = target.latest();
  // The first set-point is where the arm is, also after a time in which it did not follow or was not heard.
  const bool follows = !tick.motion_inhibited && arm->is_ready();
  is_to_be_seeded_ = is_to_be_seeded_ || !is_seeded_ || !follows || !state;
  if (!follows) active_ = nullptr;  // it stops by itself, and not where a motion of before would have it
  if (state && is_to_be_seeded_ && !is_moving()) {
    seed(*state);
    is_to_be_seeded_ = !follows;
  }
  // A target that was published before the last Start is not followed after it, even if it is published
  // again.
  if (wanted && !tick.may_follow(wanted.sampled_at())) targets_.leave(*wanted);
  if (!is_seeded_) {
    feedback.set_holding("no joint positions from the arm yet");
    idle_ = true;
    return;
  }
  char broken[sizeof(RobotLead::holding)];
  std::snprintf(broken, sizeof(broken), "the arm is in fault: %.200s", arm->fault().cause());
  const char* const held = !arm->fault().is_ok()   ? broken
                           : !state                ? "the arm no longer tells its joint positions"
                           : tick.motion_inhibited ? "motion is inhibited"
                           : !follows ? "the arm is not ready: it is being switched on, or finds its home"
                           : tick.stop_requested ? "stop requested"
                                                 : nullptr;
  look(tick);
  MotionSource* const chosen = held == nullptr ? choose(wanted) : nullptr;
  lead(chosen, wanted, elapsed);
  command(elapsed);
  tell(chosen, wanted, held);

  const bool settled = !state || (state->position_map() - set_point_).cwiseAbs().maxCoeff() < arrived;
  const bool more =
      wanted && !tick.stop_requested && may_follow_targets(runtime.mode) && targets_.is_pending(*wanted);
  stands_still_ = !is_moving() && settled && !steps_.is_wanted();
  idle_ = stands_still_ && !more;
}

void RobotControl::seed(const JointState& state) noexcept {
  const KinematicChain& chain = arm->kinematic_chain();
  set_point_ = within_limits(chain, state.position_map());
  const Eigen::Isometry3d tool = forward_kinematics(chain, set_point_);
  tool_position_ = tool.translation();
  active_ = nullptr;
  is_seeded_ = true;
  steps_.cancel();
  targets_.start(to_pose(tool));
}

/// What is asked for in this cycle.
void RobotControl::look(const Tick& tick) noexcept {
  const KinematicChain& chain = arm->kinematic_chain();
  refused_by_mode_ = nullptr;
  if (runtime.mode != ControlMode::manual) has_ignored_target_ = false;
  JogWish wish = held_arrows(runtime, chain);
  if (asks_for_missing_joint(runtime, chain)) restrain("the arm has no such joint");
  if (const auto asked = velocity.latest()) wish.tool.linear += asked->linear_map();
  if (const auto asked = turning.latest()) wish.tool.angular += asked->angular_map();
  if (const auto asked = joint_jog.latest()) wish.joints += asked->velocity_map();
  refused_wish_ = tool_jog_.want(wish.tool);
  if (const Status taken = joint_jog_.want(wish.joints); !taken) refused_wish_ = taken;
  if (const auto step = pressed_step(runtime)) {
    StreamLimits limits = hand_limits();
    limits.linear.velocity = std::min(limits.linear.velocity, runtime.jog_velocity);
    limits.angular.velocity = std::min(limits.angular.velocity, runtime.turn_velocity);
    if (may_jog(runtime.mode)) {
      steps_.ask(*step, {.tool = limits, .joint_share = runtime.joint_share});
    } else {
      refused_by_mode_ = steps_are_refused;
    }
  }
  const auto streamed = servo.latest();
  servo_.look(streamed, tick.may_follow(streamed.sampled_at()));
}

/// Who leads now, of those that want to and may; null: nobody.
MotionSource* RobotControl::choose(const View<Pose>& wanted) noexcept {
  if (steps_.is_wanted()) return &steps_;
  if (tool_jog_.is_wanted() || joint_jog_.is_wanted()) {
    if (!may_jog(runtime.mode)) {
      refused_by_mode_ = jog_is_refused;
    } else if (tool_jog_.is_wanted()) {
      return &tool_jog_;
    } else {
      return &joint_jog_;
    }
  }
  if (may_follow_targets(runtime.mode)) {
    if (servo_.is_wanted()) return &servo_;
    if (wanted) return &targets_;
    return nullptr;
  }
  if (wanted && targets_.leave(*wanted)) {
    has_ignored_target_ = true;
    refused_by_mode_ = targets_are_refused;
  }
  if (servo_.is_wanted()) refused_by_mode_ = servo_is_refused;
  return nullptr;
}

void RobotControl::lead(MotionSource* chosen, const View<Pose>& wanted, double elapsed) noexcept {
  const bool others = (chosen != nullptr && chosen != &targets_) || (is_moving() && active_ != &targets_);
  if (others && wanted) targets_.leave(*wanted);
  if (chosen == nullptr && active_ == &targets_) targets_.interrupt();
  if (chosen != nullptr && chosen != active_ && !is_moving()) {
    active_ = chosen;
    active_->begin(set_point_);
  }
  // A step that was asked for when nothing may move is not begun later.
  if (chosen == nullptr) steps_.cancel();
  if (active_ == nullptr) return;
  const bool goes_on = active_ == chosen;
  if (goes_on && active_ == &targets_) follow(*wanted);
  active_->advance(elapsed, goes_on);
  set_point_ = active_->set_point();
  if (is_moving() && active_ != &steps_) steps_.forget_refusal();
}

void RobotControl::follow(const Pose& wanted) noexcept {
  const auto said = targets_.follow(wanted, runtime.speed);
  if (!said) return;
  if (said->accepted) {
    ++feedback.motions;
  } else {
    if (feedback.refusals++ == 0) feedback.set_first_refusal(targets_.refusal());
    log_warning(refusals_, name(), "{}", targets_.refusal());
  }
  answer.publish(*said);
}

void RobotControl::tell(const MotionSource* chosen, const View<Pose>& wanted, const char* held) noexcept {
  if (active_ != nullptr && active_ == chosen) restrain(active_->restraint());
  if (chosen == &steps_ && !steps_.refusal()) restrain("a step is refused, or ended early");
  if (!refused_wish_) restrain("what a hand wants is not a number");
  if (refused_by_mode_ != nullptr) restrain(refused_by_mode_);
  tell_why(chosen, wanted, held);
  const bool lost = followed_servo_ && chosen == nullptr && held == nullptr;
  if (lost) log_warning(losses_, name(), "{}", servo_.reason());
  followed_servo_ = chosen == &servo_;
  feedback.moving = is_moving();
  feedback.activity = activity();
  feedback.stepping = steps_.is_wanted();
  feedback.set_point_map() = set_point_;
  publish_lead();
}

void RobotControl::publish_lead() noexcept {
  RobotLead said{};
  said.activity = feedback.activity;
  said.mode = runtime.mode;
  said.moving = feedback.moving;
  said.stepping = feedback.stepping;
  said.in_fault = !arm->fault().is_ok();
  said.set_holding(feedback.holding_view());
  led_by.publish(said);
}

/// feedback.holding: the first of what there is to say.
void RobotControl::tell_why(const MotionSource* chosen, const View<Pose>& wanted, const char* held) noexcept {
  if (held != nullptr) return feedback.set_holding(held);
  if (!refused_wish_) return feedback.set_holding(refused_wish_.cause());
  if (refused_by_mode_ != nullptr) return feedback.set_holding(refused_by_mode_);
  if (active_ != nullptr && active_ == chosen) {
    if (const Restraint found = active_->restraint(); found.reason != nullptr) {
      char text[240];
      std::snprintf(text, sizeof(text), "%s: %s",
                    is_moving() ? "slower than asked for" : "the tool cannot go on", found.reason);
      return feedback.set_holding(text);
    }
  }
  if (!steps_.refusal() && !is_moving()) return feedback.set_holding(steps_.refusal().cause());
  if (chosen == nullptr) return feedback.set_holding(reason_to_hold(wanted));
  feedback.set_holding(chosen == &targets_ ? targets_.refusal() : "");
}

/// Where nobody leads the arm, and some could.
const char* RobotControl::reason_to_hold(const View<Pose>& wanted) const noexcept {
  if (!may_follow_targets(runtime.mode)) return has_ignored_target_ ? targets_are_refused : "";
  if (*servo_.reason() != '\0') return servo_.reason();
  switch (wanted.reason()) {
    case NullReason::nothing_yet:
      return "no target yet";
    case NullReason::not_registered:
      return "";  // it is moved by hand alone
    default:
      return name_of(wanted.reason());
  }
}

RobotActivity RobotControl::activity() const noexcept {
  if (active_ == &steps_) return RobotActivity::step;
  if (active_ == &tool_jog_) return RobotActivity::jog;
  if (active_ == &joint_jog_) return RobotActivity::joint_jog;
  if (active_ == &servo_) return RobotActivity::servo;
  return active_ == &targets_ ? RobotActivity::target : RobotActivity::none;
}

/// Since the cycle before, in s.
double RobotControl::elapsed_in(const Tick& tick) noexcept {
  const double elapsed = last_cycle_ == Time{} ? 0.0 : seconds(tick.nominal - last_cycle_);
  last_cycle_ = tick.nominal;
  return std::clamp(elapsed, 0.0, configuration.longest_advance);
}

void RobotControl::command(double elapsed) noexcept {
  JointPositions positions{};
  positions.position_map() = set_point_;
  arm->command(positions);
  const Eigen::Vector3d tool = forward_kinematics(arm->kinematic_chain(), set_point_).translation();
  feedback.tool_speed = elapsed > 0 ? (tool - tool_position_).norm() / elapsed : 0.0;
  tool_position_ = tool;
}

void RobotControl::publish(const JointState& state) noexcept {
  const Time at = arm->measured_at();
  pose.publish(to_pose(forward_kinematics(arm->kinematic_chain(), state.position_map())), at);
  joints.publish(state, at);
}

StreamLimits RobotControl::hand_limits() const noexcept {
  return {.linear = {.velocity = std::min(configuration.hand_speed, manual_speed),
                     .acceleration = configuration.hand_acceleration,
                     .jerk = configuration.hand_jerk},
          .angular = {.velocity = configuration.hand_turn_velocity,
                      .acceleration = configuration.hand_turn_acceleration,
                      .jerk = configuration.hand_turn_jerk}};
}

StreamLimits RobotControl::servo_limits() const noexcept {
  return {.linear = {.velocity = configuration.servo_velocity,
                     .acceleration = configuration.servo_acceleration,
                     .jerk = configuration.servo_jerk},
          .angular = {.velocity = configuration.servo_turn_velocity,
                      .acceleration = configuration.servo_turn_acceleration,
                      .jerk = configuration.servo_turn_jerk}};
}

}  // namespace flexrf::user
