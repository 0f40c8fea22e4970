// What each mode of a robot permits.
#pragma once

#include "types/control_mode.hpp"

namespace flexrf::user {

// The tool's reduced speed while a person leads it (ISO 10218-1, manual reduced speed), in m/s. No safety
// function.
inline constexpr double manual_speed = 0.25;

constexpr bool may_jog(ControlMode mode) noexcept {
  return mode != ControlMode::automatic;
}
constexpr bool may_follow_targets(ControlMode mode) noexcept {
  return mode != ControlMode::manual;
}

inline constexpr const char* jog_is_refused = "jog is refused in automatic mode: choose manual";
inline constexpr const char* steps_are_refused = "steps are refused in automatic mode: choose manual";
inline constexpr const char* targets_are_refused =
    "targets are not followed in manual mode: choose automatic";
inline constexpr const char* servo_is_refused =
    "the pose stream is not followed in manual mode: choose automatic";

}  // namespace flexrf::user
