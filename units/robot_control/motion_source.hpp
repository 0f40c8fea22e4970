// MotionSource: one of the things that may lead an arm. The unit has several, and lets one at a time.
#pragma once

#include "motion/kinematics.hpp"

namespace flexrf::user {

// The unit's thread; nothing allocates.
class MotionSource {
 public:
  virtual ~MotionSource() = default;

  // It leads the arm from now on, which rests at these joint positions (rad or m, within their limits).
  virtual void begin(const JointVector& set_point) noexcept = 0;
  // A cycle of `elapsed` s, 0 or more. `goes_on` false: another one shall lead, or none may, and it comes to
  // rest within its limits.
  virtual void advance(double elapsed, bool goes_on) noexcept = 0;

  virtual bool is_at_rest() const noexcept = 0;
  // Joint positions to command now.
  virtual const JointVector& set_point() const noexcept = 0;
  // What it does less than asked for.
  virtual Restraint restraint() const noexcept = 0;
};

}  // namespace flexrf::user
