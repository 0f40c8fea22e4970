#pragma once

#include "base/time.hpp"
#include "motion/kinematics.hpp"

namespace flexrf {

/// How an arm's joints follow their commands: each is a first-order servo (rate = difference / lag) whose
/// rate, change of rate and range are limited. Integrated in fixed steps of 1 ms, so that the motion depends
/// on the commands and their times only, not on how often one looks. Allocates nothing.
class ArmModel {
 public:
  /// At rest in the chain's home posture. `lag` in s, above 0.
  void reset(const KinematicChain& chain, double lag);
  /// Likewise, but where it is, as an arm whose control begins anew; in the home posture only at first.
  void restart(const KinematicChain& chain, double lag);

  /// Follow these positions (rad or m, finite) from now on, as far as the limits allow.
  void follow(const JointVector& positions);
  /// Come to rest as fast as the limits allow, and stay.
  void hold();
  /// This joint (from 0) does not move until another one, or none (-1), is named.
  void stick(int joint);

  /// Moves the model on to `now`; the first call only sets its clock. After a gap of more than a second the
  /// model moves for one second.
  void advance(Time now);

  bool is_at_rest() const;
  /// As of the time advanced to.
  JointVector position() const { return position_ + velocity_ * seconds(now_ - stepped_until_); }
  const JointVector& velocity() const { return velocity_; }
  /// The positions that the joints follow.
  const JointVector& followed() const { return command_; }

 private:
  void step();
  double approach_velocity(double distance, const ChainJoint& joint) const;

  const KinematicChain* chain_ = nullptr;
  double lag_ = 0.01;
  JointVector position_ = JointVector::Zero();
  JointVector velocity_ = JointVector::Zero();
  JointVector command_ = JointVector::Zero();
  bool holding_ = true;
  int stuck_ = -1;
  Time now_{};
  Time stepped_until_{};
};

}  // namespace flexrf
