#include "units/robot_control/tool_jog.hpp"

namespace flexrf::user {
namespace {

// Each cycle says anew what is wanted: a thread that is late by more has other troubles.
constexpr double longest_silence = 0.1;  // s

}  // namespace

void ToolJog::use(const KinematicChain& chain, const StreamLimits& limits) noexcept {
  stream_.use(chain, limits, longest_silence);
  wanted_ = {};
  is_wanted_ = false;
}

Status ToolJog::want(const ToolVelocity& wanted) noexcept {
  wanted_ = {};
  is_wanted_ = false;
  if (!wanted.linear.allFinite() || !wanted.angular.allFinite())
    return Status::error(StatusCode::invalid_argument, "the velocity or the turning wanted is not a number");
  wanted_ = wanted;
  is_wanted_ = !wanted.is_zero();
  return {};
}

void ToolJog::begin(const JointVector& set_point) noexcept {
  stream_.seed(set_point);
}

void ToolJog::advance(double elapsed, bool goes_on) noexcept {
  // want() let only finite velocities through.
  [[maybe_unused]] const Status taken = stream_.want(goes_on ? wanted_ : ToolVelocity{});
  stream_.advance(elapsed);
}

}  // namespace flexrf::user
