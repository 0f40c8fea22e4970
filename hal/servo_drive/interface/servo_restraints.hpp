// What drives say of commands that they do not follow as they are. Arrays, so that each has one address in
// all of a program: a reason is the same while its address is.
#pragma once

namespace flexrf::servo_restraints {

inline constexpr char out_of_range[] = "a position outside of `lowest` to `highest` is not gone to";
inline constexpr char too_far[] =
    "a way of more than half of what the drive's counter holds is not gone at once";
inline constexpr char end_of_range[] =
    "it is slowed down before the end of its range, `lowest` or `highest`, and goes no farther";
inline constexpr char too_fast[] = "a velocity above `fastest` is not taken";
inline constexpr char led_too_fast[] =
    "set-points that jump, or move faster than `fastest` and `acceleration`, are followed no faster, and it "
    "falls behind them";
inline constexpr char set_points_ignored[] =
    "the drive says that it does not follow its set-points (bit 12 of its statusword is 0)";
inline constexpr char own_speed[] =
    "the speed of a target is not told (`tells_speed = false`): it goes as fast as its maker's tool has set "
    "it";
inline constexpr char target_waits[] =
    "a target waits until it is at the one before (`changes_target_at_once = false`)";
inline constexpr char another_mode[] =
    "a command of another mode than the configured `mode` is without effect";
inline constexpr char no_homing[] =
    "it is not sent home: `homing_method` is 0, its encoder is taken for absolute";

}  // namespace flexrf::servo_restraints
