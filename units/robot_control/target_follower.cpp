#include "units/robot_control/target_follower.hpp"

#include <algorithm>
#include <cmath>

namespace flexrf::user {
namespace {

/// What is not a number equals nothing, and would be taken for another target in each cycle.
bool same_number(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

bool same(const Pose& a, const Pose& b) {
  return std::equal(a.position.begin(), a.position.end(), b.position.begin(), same_number) &&
         std::equal(a.orientation.begin(), a.orientation.end(), b.orientation.begin(), same_number);
}

}  // namespace

void TargetFollower::use(const KinematicChain& chain) noexcept {
  motion_.use(chain);
  handled_.reset();
  kept_ = {};
  refusal_ = {};
}

bool TargetFollower::is_pending(const Pose& wanted) const noexcept {
  return !(handled_ && same(wanted, *handled_));
}

bool TargetFollower::leave(const Pose& wanted) noexcept {
  const bool pending = is_pending(wanted);
  handled_ = wanted;
  refusal_ = {};
  return pending;
}

void TargetFollower::interrupt() noexcept {
  if (motion_.is_moving()) handled_.reset();
}

std::optional<TargetAnswer> TargetFollower::follow(const Pose& wanted, double speed) noexcept {
  if (motion_.is_moving() || !is_pending(wanted)) return std::nullopt;
  // Whoever asked for more than can be reached goes on from what holds: the reason stays to be read.
  const bool goes_back = handled_ && same(wanted, kept_);
  handled_ = wanted;
  if (goes_back) return std::nullopt;
  refusal_ = motion_.move_to(wanted, speed);
  if (refusal_) kept_ = wanted;
  TargetAnswer said{};
  said.accepted = refusal_.is_ok();
  said.kept = kept_;
  said.set_reason(refusal_.cause());
  return said;
}

void TargetFollower::advance(double elapsed, bool goes_on) noexcept {
  if (!goes_on) motion_.stop();
  motion_.advance(elapsed);
}

}  // namespace flexrf::user
