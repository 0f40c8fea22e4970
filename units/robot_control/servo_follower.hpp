// ServoFollower: leads the tool along a stream of poses, as from a camera. When no more comes, the arm holds.
#pragma once

#include <optional>

#include "motion/pose_stream.hpp"
#include "runtime/blackboard/ports.hpp"
#include "types/servo_target.hpp"
#include "units/robot_control/motion_source.hpp"

namespace flexrf::user {

class ServoFollower final : public MotionSource {
 public:
  // Before anything else. The chain outlives this. `max_age` in s.
  void use(const KinematicChain& chain, const StreamLimits& limits, double max_age) noexcept;

  // Once a cycle, what the stream says now. What it said in a cycle in which nothing may move is not followed
  // later.
  void look(const View<ServoTarget>& said, bool may_move) noexcept;
  // There is a pose to follow that is young enough.
  bool is_wanted() const noexcept { return target_.has_value(); }
  // Why there is none; empty: there is one, or nobody makes any.
  const char* reason() const noexcept { return reason_; }

  void begin(const JointVector& set_point) noexcept override { stream_.seed(set_point); }
  void advance(double elapsed, bool goes_on) noexcept override;
  bool is_at_rest() const noexcept override { return stream_.is_at_rest(); }
  const JointVector& set_point() const noexcept override { return stream_.set_point(); }
  Restraint restraint() const noexcept override { return stream_.restraint(); }

 private:
  PoseStream stream_;
  std::optional<Eigen::Isometry3d> target_;
  std::optional<std::uint64_t> left_;  // the item that was there when nothing could move
  std::uint32_t way_ = 0;
  double part_ = 1;     // of the limits of velocity
  double fastest_ = 0;  // m/s, by those limits
  double age_ = 0;
  double max_age_ = 0;
  const char* reason_ = "";
};

}  // namespace flexrf::user
