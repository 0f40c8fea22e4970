// What all drivers of Gripper have in common: goals are checked, and what happens is counted.
#pragma once

#include <optional>

#include "gripper_interface.hpp"
#include "hal/driver/trouble_log.hpp"

namespace flexrf {

struct GripperCapabilities;
struct GripperGoal;
struct GripperState;

/// Why this gripper cannot go there: not a finite number, a speed or force that is not above 0, or an opening
/// between the ends of one that knows the ends alone.
Status check_goal(const GripperGoal& goal, const GripperCapabilities& capabilities) noexcept;
/// Kept within closed_width and open_width.
double within_reach(double opening, const GripperCapabilities& capabilities) noexcept;
/// What of a goal that it can go to is not done as it is asked for; none: all is.
Restraint restraint_of(const GripperGoal& goal, const GripperCapabilities& capabilities) noexcept;
/// Error: the widths of the configuration are no range.
Status check_widths(double closed_width, double open_width) noexcept;

/// Fills the feedback, counts, and says troubles in the log. The thread of the gripper.
class GripperReport {
 public:
  void reset() noexcept {
    heard_ = held_ = lost_ = false;
    trouble_ = StatusCode::ok;
  }
  /// `name`: of the device.
  void fill(const char* name, GripperFeedback& feedback, const std::optional<GripperState>& state,
            const Status& trouble, Time now) noexcept;

 private:
  bool heard_ = false;  // before, it was not there yet, which is no trouble
  bool held_ = false;
  bool lost_ = false;
  StatusCode trouble_ = StatusCode::ok;
  TroubleLog log_;
};

}  // namespace flexrf
