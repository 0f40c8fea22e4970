// GuardedMotion: an online motion of the tool that its arm's joints can follow. Private to the streams.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>

#include "motion/joint_tracking.hpp"
#include "motion/stream_limits.hpp"

namespace flexrf {

// What is promised by induction: in each cycle the tool can come to rest, as its limits have it, with all
// joints within their ranges and velocities. A step is taken only when this holds after it, too; else a
// slower one is tried, and when none will do, the stop that was found possible in the cycle before is made.
// (Where it ends is known before: a fail-safe trajectory, as in Magdici and Althoff 2016 for vehicles.) From
// rest, a motion begins only when it may go on for a while: there is no creeping into a limit.
//
// Motion: a PoseMotion or a VelocityMotion; a plain value, so that the way ahead is walked by a copy. One
// thread; nothing allocates. A cycle takes some tens of microseconds while nothing is in the way, and
// three times as long where something is.
template <class Motion>
class GuardedMotion {
 public:
  // Before anything else. The chain outlives this.
  void use(const KinematicChain& chain, const StreamLimits& limits) noexcept {
    chain_ = &chain;
    motion_ = {};
    motion_.set_limits(limits);
  }
  // For what begins next; at rest.
  void set_limits(const StreamLimits& limits) noexcept { motion_.set_limits(limits); }
  // At rest with these joint positions: rad or m, finite, within their limits.
  void seed(const JointVector& joints) noexcept {
    joints_ = joints;
    motion_.place(forward_kinematics(*chain_, joints));
    forget();
  }

  // `elapsed` s on, above 0. `step(motion, part, time)` moves a motion on by `time` s towards what is wanted,
  // at no more than `part` of the velocity that is asked for.
  template <class Step>
  void advance(double elapsed, Step step) noexcept {
    const bool rests = motion_.is_at_rest();
    if (rests) forget();
    if (!stops_) {
      // At rest nothing is in a hurry: one part in a cycle.
      const std::size_t first = rests ? trial_ : 0;
      const std::size_t end = rests ? first + 1 : std::size(parts);
      for (std::size_t n = first; n < end; ++n) {
        const double less = parts[n];
        if (less * part_ < slowest) break;
        Motion next = motion_;
        step(next, less * part_, elapsed);
        if (rests && next.is_at_rest() && is_same_place(next)) return;  // nothing is wanted
        JointVector joints = joints_;
        Restraint found = track(*chain_, next.pose(), elapsed, in_motion, joints);
        if (found.reason == nullptr) found = look_ahead(next, joints);
        if (found.reason == nullptr && rests) found = try_out(step, less * part_);
        if (found.reason == nullptr) {
          accept(next, joints, less, elapsed);
          return;
        }
        if (n == first) in_the_way_ = found;
      }
      restraint_ = in_the_way_;
      if (rests) {
        trial_ = (trial_ + 1) % std::size(parts);
        return;
      }
      stops_ = true;
    }
    stop(elapsed);
  }

  // Comes to rest as fast as the limits allow; what stood in the way of going on stays told until then.
  void brake(double elapsed) noexcept {
    if (motion_.is_at_rest()) return forget();
    stop(elapsed);
  }

  const Motion& motion() const noexcept { return motion_; }
  const JointVector& joints() const noexcept { return joints_; }
  // Why the tool is slower than asked for, or does not move; none: it does as asked.
  const Restraint& restraint() const noexcept { return restraint_; }
  // Cycles in which not even the stop was possible as the limits have it, and the joints' velocities went
  // before.
  std::uint64_t emergencies() const noexcept { return emergencies_; }

 private:
  static constexpr double parts[] = {1.0, 0.5, 0.15};  // of the speed so far
  static constexpr double slowest = 0.02;              // of the speed asked for; else it rests
  static constexpr double recovery = 1.0;              // s from nothing to the whole speed
  // Parts of the joints' velocities. What looks ahead sees means over longer times than a cycle.
  static constexpr double ahead = 0.75;
  static constexpr double in_motion = 0.95;
  static constexpr int samples = 20;
  static constexpr double shortest_sample = 0.005;  // s
  static constexpr int trial_steps = 5;
  static constexpr double trial_step = 0.02;  // s

  void forget() noexcept {
    part_ = 1;
    stops_ = false;
    restraint_ = {};
  }

  bool is_same_place(const Motion& next) const noexcept {
    return next.pose().matrix() == motion_.pose().matrix();
  }

  // Whether the stop from here is possible.
  Restraint look_ahead(Motion motion, JointVector joints) const noexcept {
    const double interval = std::max(shortest_sample, motion.braking_time() / samples);
    for (int n = 0; n <= samples && !motion.is_at_rest(); ++n) {
      motion.brake(interval);
      if (const Restraint found = track(*chain_, motion.pose(), interval, ahead, joints);
          found.reason != nullptr)
        return found;
    }
    return {};
  }

  // Whether what begins here leads anywhere.
  template <class Step>
  Restraint try_out(Step& step, double part) const noexcept {
    Motion motion = motion_;
    JointVector joints = joints_;
    for (int n = 0; n < trial_steps; ++n) {
      step(motion, part, trial_step);
      if (const Restraint found = track(*chain_, motion.pose(), trial_step, ahead, joints);
          found.reason != nullptr)
        return found;
    }
    return look_ahead(motion, joints);
  }

  void accept(const Motion& next, const JointVector& joints, double less, double elapsed) noexcept {
    motion_ = next;
    joints_ = joints;
    trial_ = 0;
    if (less < 1) {
      part_ *= less;
      restraint_ = in_the_way_;
    } else {
      part_ = std::min(1.0, part_ + elapsed / recovery);
      if (part_ == 1) restraint_ = {};
    }
  }

  void stop(double elapsed) noexcept {
    double time = elapsed;
    for (int halvings = 0; halvings < 8; ++halvings, time /= 2) {
      Motion next = motion_;
      next.brake(time);
      JointVector joints = joints_;
      const Restraint found = track(*chain_, next.pose(), elapsed, 1.0, joints);
      if (found.reason == nullptr) {
        motion_ = next;
        joints_ = joints;
        return;
      }
      if (halvings == 0) {
        ++emergencies_;
        restraint_ = found;
      }
    }
    motion_.halt();
  }

  const KinematicChain* chain_ = nullptr;
  Motion motion_;
  JointVector joints_ = JointVector::Zero();
  double part_ = 1;         // of the speed asked for
  std::size_t trial_ = 0;   // which of the parts is tried next at rest
  bool stops_ = false;      // nothing else is possible, until it rests
  Restraint in_the_way_{};  // of what was asked for last and could not be
  Restraint restraint_{};
  std::uint64_t emergencies_ = 0;
};

}  // namespace flexrf
