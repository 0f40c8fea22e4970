#include "hal/robot_arm/interface/arm_supervision.hpp"

#include <cmath>

namespace flexrf {

Status ArmSupervision::look(const std::optional<JointState>& state, std::span<const double> error,
                            bool may_move, Time now) noexcept {
  if (!may_move) heard_ = Time{};
  if (!may_move) return {};
  if (!state) {
    // One whose drives are still on their way to be enabled and homed has not said anything yet.
    const double silent = heard_ == Time{} ? 0 : seconds(now - heard_);
    if (limits_.silence == 0 || silent <= limits_.silence) return {};
    return Status::error(
        StatusCode::unavailable,
        "it has told no joint positions for %.2f s (`silence`), and where it is is not known", silent);
  }
  heard_ = now;
  for (std::size_t i = 0; i < chain_->joint_count && i < error.size(); ++i) {
    const double most = limits_.following_time * chain_->joints[i].velocity;
    if (limits_.following_time == 0 || std::abs(error[i]) <= most) continue;
    const std::string_view name = chain_->joints[i].name;
    return Status::error(
        StatusCode::device_fault,
        "%.*s is %.3f %s behind, more than it moves in `following_time` (%g s): does it stick, or does "
        "its sensor?",
        static_cast<int>(name.size()), name.data(), std::abs(error[i]),
        chain_->joints[i].kind == JointKind::prismatic ? "m" : "rad", limits_.following_time);
  }
  return {};
}

}  // namespace flexrf
