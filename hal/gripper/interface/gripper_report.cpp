#include "hal/gripper/interface/gripper_report.hpp"

#include <algorithm>
#include <cmath>

#include "hal/gripper/interface/gripper.hpp"

namespace flexrf {

Status check_widths(double closed_width, double open_width) noexcept {
  if (closed_width < open_width) return {};
  return Status::error(StatusCode::invalid_argument,
                       "configuration.closed_width (%g m) is not less than open_width (%g m)", closed_width,
                       open_width);
}

double within_reach(double opening, const GripperCapabilities& capabilities) noexcept {
  return std::clamp(opening, capabilities.closed_width, capabilities.open_width);
}

Status check_goal(const GripperGoal& goal, const GripperCapabilities& capabilities) noexcept {
  if (!std::isfinite(goal.opening))
    return Status::error(StatusCode::invalid_argument, "it was commanded to an opening that is no number");
  for (const std::optional<double>& value : {goal.speed, goal.force}) {
    if (value && !(std::isfinite(*value) && *value > 0))
      return Status::error(StatusCode::invalid_argument,
                           "it was commanded with a speed or force that is no number above 0");
  }
  const double opening = within_reach(goal.opening, capabilities);
  if (!capabilities.positions && opening != capabilities.closed_width && opening != capabilities.open_width) {
    return Status::error(StatusCode::invalid_argument,
                         "it was commanded to %g m, and knows open (%g m) and closed (%g m) alone; see its "
                         "capabilities()",
                         goal.opening, capabilities.open_width, capabilities.closed_width);
  }
  return {};
}

Restraint restraint_of(const GripperGoal& goal, const GripperCapabilities& capabilities) noexcept {
  if (const double kept = within_reach(goal.opening, capabilities); kept != goal.opening)
    return {"an opening outside of `closed_width` to `open_width` is not gone to", goal.opening, kept};
  if (goal.speed && !capabilities.speed) return {.reason = "a speed is without effect: it has but one"};
  if (goal.force && !capabilities.force) return {.reason = "a force is without effect: it has but one"};
  if (goal.speed) {
    const double kept = std::min(std::max(*goal.speed, capabilities.slowest), capabilities.fastest);
    if (kept != *goal.speed) return {"a speed that it cannot be told is not taken", *goal.speed, kept};
  }
  if (goal.force) {
    const double kept = std::min(std::max(*goal.force, capabilities.weakest), capabilities.strongest);
    if (kept != *goal.force) return {"a force that it cannot be told is not taken", *goal.force, kept};
  }
  return {};
}

void GripperReport::fill(const char* name, GripperFeedback& feedback,
                         const std::optional<GripperState>& state, const Status& trouble, Time now) noexcept {
  log_.look(name, trouble, now);
  const GripperState told = state.value_or(GripperState{});
  feedback.opening_known = told.opening.has_value();
  if (told.opening) feedback.opening = *told.opening;
  feedback.activated = told.activated;
  feedback.moving = told.moving;
  feedback.object = told.object;
  feedback.set_trouble(trouble.cause());
  const bool lost = told.object == GripperObject::lost;
  if (told.holds_object() && !held_) ++feedback.grips;
  if (lost && !lost_) ++feedback.losses;
  held_ = told.holds_object();
  lost_ = lost;
  heard_ = heard_ || state;
  if (!heard_ || trouble.code() == trouble_) return;
  ++(trouble.is_ok() ? feedback.recoveries : feedback.troubles);
  trouble_ = trouble.code();
}

}  // namespace flexrf
