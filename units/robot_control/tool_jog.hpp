// ToolJog: a hand moves and turns the tool, by arrows and inputs, as long as it wants.
#pragma once

#include "base/status.hpp"
#include "motion/velocity_stream.hpp"
#include "units/robot_control/motion_source.hpp"

namespace flexrf::user {

class ToolJog final : public MotionSource {
 public:
  // Before anything else. The chain outlives this.
  void use(const KinematicChain& chain, const StreamLimits& limits) noexcept;

  // Once a cycle. What is not a number is refused with its cause, and nothing is wanted.
  Status want(const ToolVelocity& wanted) noexcept;
  bool is_wanted() const noexcept { return is_wanted_; }

  void begin(const JointVector& set_point) noexcept override;
  void advance(double elapsed, bool goes_on) noexcept override;
  bool is_at_rest() const noexcept override { return stream_.is_at_rest(); }
  const JointVector& set_point() const noexcept override { return stream_.set_point(); }
  Restraint restraint() const noexcept override { return stream_.restraint(); }

 private:
  VelocityStream stream_;
  ToolVelocity wanted_;
  bool is_wanted_ = false;
};

}  // namespace flexrf::user
