#include "units/robot_control/servo_follower.hpp"

#include <algorithm>

#include "motion/pose_conversion.hpp"

namespace flexrf::user {
namespace {

// Each reason's own words, as they live for ever.
const char* words_of(NullReason reason) {
  switch (reason) {
    case NullReason::nothing_yet:
      return "the pose stream has not begun: the arm holds";
    case NullReason::writer_stopped:
      return "who makes the pose stream was stopped: the arm holds";
    case NullReason::writer_faulted:
      return "who makes the pose stream is in fault: the arm holds";
    case NullReason::writer_retired:
      return "who makes the pose stream was retired: the arm holds";
    case NullReason::not_registered:
      return "";  // it is led by others alone
    default:
      return "the pose stream is not there: the arm holds";
  }
}

}  // namespace

void ServoFollower::use(const KinematicChain& chain, const StreamLimits& limits, double max_age) noexcept {
  stream_.use(chain, limits, max_age);
  target_.reset();
  left_.reset();
  fastest_ = limits.linear.velocity;
  max_age_ = max_age;
  reason_ = "";
}

void ServoFollower::look(const View<ServoTarget>& said, bool may_move) noexcept {
  target_.reset();
  reason_ = "";
  if (said && !may_move) left_ = said.sequence();
  if (!said) {
    reason_ = words_of(said.reason());
  } else if (!said->valid) {
    reason_ = "the pose stream has nowhere to go to: the arm holds";
  } else if (left_ == said.sequence()) {
    reason_ = "the pose stream is from before the Start: the arm holds";
  } else if (seconds(said.age()) > max_age_) {
    reason_ = "the pose stream is too old: the arm holds";
  } else if (const Eigen::Isometry3d pose = to_isometry(said->pose); !is_pose(pose)) {
    reason_ = "the pose stream tells what is no pose: the arm holds";
  } else {
    target_ = pose;
    way_ = said->way;
    part_ = said->speed > 0 ? std::min(1.0, said->speed / fastest_) : 1;
    age_ = seconds(said.age());
  }
}

void ServoFollower::advance(double elapsed, bool goes_on) noexcept {
  if (goes_on && target_) {
    // look() let only poses through.
    [[maybe_unused]] const Status taken = stream_.aim(*target_, age_, way_, part_);
  } else {
    stream_.let_go();
  }
  stream_.advance(elapsed);
}

}  // namespace flexrf::user
