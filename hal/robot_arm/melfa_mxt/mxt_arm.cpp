#include "hal/robot_arm/melfa_mxt/mxt_arm.hpp"

namespace flexrf::melfa {

Status lost_controller(const char* where, double silence_limit, const PacingCounters& counters) noexcept {
  return Status::error(
      StatusCode::timeout,
      "no answer from %s for %g s while it was led (%llu packets lost, %llu datagrams foreign "
      "so far): does its program still run, without an alarm, and is the cable in?",
      where, silence_limit, static_cast<unsigned long long>(counters.lost),
      static_cast<unsigned long long>(counters.foreign));
}

Status not_heard_yet(const char* where, std::size_t unknown_joint) noexcept {
  if (unknown_joint > 0) {
    return Status::error(
        StatusCode::invalid_argument,
        "%s tells where joint %zu is, which the URDF does not have, and is not led: give the "
        "URDF each joint of the controller, or name the right controller",
        where, unknown_joint);
  }
  return Status::error(
      StatusCode::timeout,
      "no answer from %s yet, it is asked until it answers: is it on, its program at MXT, and "
      "the cable in?",
      where);
}

}  // namespace flexrf::melfa
