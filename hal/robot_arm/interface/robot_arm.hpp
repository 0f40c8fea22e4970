// RobotArm: an arm that follows joint positions cyclically.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "hal/driver/actuator.hpp"
#include "hal/robot_arm/interface/arm_supervision.hpp"
#include "motion/joint_pace.hpp"
#include "motion/kinematic_chain.hpp"
#include "motion/kinematics.hpp"
#include "robot_arm_interface.hpp"
#include "types/joint_positions.hpp"
#include "types/joint_state.hpp"

namespace flexrf {

/// Everything: the thread the arm lives in. Made safe, it comes to rest, says so, and stays
/// there [robot-arm-8]. What its drives report as a fault is the arm's [robot-arm-9].
class RobotArm : public Actuator<RobotArmInterface> {
 public:
  using Actuator::Actuator;

  const KinematicChain& kinematic_chain() const noexcept { return *chain; }

  /// What the sensors said last, as of this cycle; nothing while they say nothing [robot-arm-1].
  virtual std::optional<JointState> state() const noexcept = 0;
  /// When that was measured, or told where the far end has no clock of ours: at most now, on the clock of the
  /// cycles. It stands still while nothing new is told [robot-arm-13]. No time while state() is nothing. What
  /// publishes the state gives it as the item's sampled_at.
  virtual Time measured_at() const noexcept = 0;

  /// The arm follows commands: it may act, and its drives are on and homed. While this is false, a unit that
  /// commands the arm seeds its set-points with state().
  bool is_ready() const noexcept { return may_act() && is_operational(); }

  /// Where the joints shall be (rad, or m where one slides), sent at the end of the cycle and held until the
  /// next command [robot-arm-2]; before the first it stays where it is [robot-arm-10]. The first command
  /// since is_ready() became true, or since the resting arm told no positions, is followed only if each joint
  /// is within 50 ms at its greatest velocity of state() [robot-arm-12], so that the arm does not return to a
  /// set-point of before. Otherwise it is ignored, and told.
  /// An arm keeps to its own limits whatever it is commanded [robot-arm-3], and tells it
  /// (Component::restrain()) while it does [robot-arm-4]; what is not finite puts it in fault [robot-arm-5].
  /// Without effect while is_inhibited(), and not remembered [robot-arm-6].
  void command(const JointPositions& set_points) noexcept {
    if (!may_act()) return;
    for (std::size_t i = 0; i < chain->joint_count; ++i) {
      if (std::isfinite(set_points.position[i])) continue;
      const std::string_view joint = chain->joints[i].name;
      return fail(Status::error(StatusCode::invalid_argument,
                                "joint %.*s was commanded to a position that is not a number",
                                static_cast<int>(joint.size()), joint.data()));
    }
    if (!begun_ && !begins_here(set_points)) return;
    stands_ = begun_ && set_points.position == commanded_.position;
    commanded_ = set_points;
    begun_ = true;
    follow(set_points);
  }

 protected:
  /// In follow(), by every driver, with what it follows from now on: what of it is beyond a joint's range is
  /// told.
  void tell_limits(const JointPositions& set_points) noexcept {
    restrain(restraint_of(*chain, set_points.position));
  }
  /// Likewise, by a driver that has no follower of its own: also that joints are led faster than they may go.
  void tell_limits_and_pace(const JointPositions& set_points) noexcept {
    tell_limits(set_points);
    const auto told = state();
    pace_.command(*chain, set_points.position, told ? told->position : set_points.position);
  }
  /// In initialise(), by every driver.
  /// `configuration`: the driver's.
  void begin_supervision(const auto& configuration) noexcept {
    supervision_.begin(*chain, {configuration.following_time, configuration.silence});
    pace_.forget();
    begun_ = false;
  }
  /// At the end of receive(), by every driver: an arm that does not follow what its drives are asked to
  /// (feedback.following_error), or does not say where it is, is in fault [robot-arm-7]; nothing is expected
  /// of one that may not move [robot-arm-11].
  void supervise(Time now) noexcept {
    if (const Status found = supervision_.look(state(), feedback.following_error, may_act(), now); !found)
      set_fault(found);
    if (!may_act()) pace_.forget();
    if (!is_ready() || (stands_ && !state())) begun_ = false;
    restrain(pace_.look(*chain, looked_at_ == Time{} ? 0 : seconds(now - looked_at_)));
    looked_at_ = now;
  }

 private:
  /// A command that is taken, finite.
  virtual void follow(const JointPositions& set_points) noexcept = 0;
  /// While it may act: what is commanded is followed from this cycle on.
  virtual bool is_operational() const noexcept { return true; }

  bool begins_here(const JointPositions& set_points) noexcept {
    constexpr double longest = 0.05;  // s, at a joint's greatest velocity
    const auto told = state();
    if (!told || !is_operational()) return false;
    for (std::size_t i = 0; i < chain->joint_count; ++i) {
      const ChainJoint& joint = chain->joints[i];
      const double here = std::clamp(told->position[i], joint.lower, joint.upper);
      if (std::abs(set_points.position[i] - here) <= longest * joint.velocity) continue;
      restrain(
          {"set-points do not begin where the arm is, and are not followed", set_points.position[i], here});
      return false;
    }
    return true;
  }

  ArmSupervision supervision_;
  JointPace pace_;
  bool begun_ = false;          // it is led from where it was
  bool stands_ = false;         // the last two commands were the same
  JointPositions commanded_{};  // the last one that was taken
  Time looked_at_{};
};

}  // namespace flexrf
