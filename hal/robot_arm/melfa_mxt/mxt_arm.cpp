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

}  // namespace flexrf::melfa
