// What the cases of ServoDrive have in common.
#pragma once

#include <cmath>

#include "hal/servo_drive/conformance/servo_drive_conformance.hpp"
#include "tests/verdict.hpp"

namespace flexrf::servo_drive_cases {

inline constexpr Duration cycle = std::chrono::milliseconds(7);
inline constexpr double cycle_seconds = 0.007;
inline constexpr double tolerance = 2e-3;  // an increment of a coarse drive, and its rounding
inline constexpr double acceleration = 100;
inline constexpr double start = 1;        // where the world's axis is
inline constexpr int most_cycles = 1000;  // far more than any of it takes

inline void idle_for(ServoDriveWorld& world, double duration) {
  for (double time = 0; time < duration; time += cycle_seconds) {
    world.receive(cycle);
    world.send();
  }
}

// `command` in each cycle.
template <class Command>
void do_for(ServoDriveWorld& world, double duration, Command command) {
  for (double time = 0; time < duration; time += cycle_seconds) {
    world.receive(cycle);
    command(world.drive());
    world.send();
  }
}
inline void command_for(ServoDriveWorld& world, double position, double duration) {
  do_for(world, duration, [position](ServoDrive& drive) { drive.command_position(position); });
}
inline void drive_for(ServoDriveWorld& world, double velocity, double duration) {
  do_for(world, duration, [velocity](ServoDrive& drive) { drive.command_velocity(velocity); });
}
// Once, between receive and send.
template <class Command>
void do_once(ServoDriveWorld& world, Command command) {
  do_for(world, cycle_seconds / 2, command);
}

inline ServoState state_of(ServoDriveWorld& world) {
  return world.drive().state().value_or(ServoState{.position = -1e9});
}

// Cycles without a command; a drive may take its time, and is not waited for for ever.
template <class Condition>
bool await(ServoDriveWorld& world, Condition condition) {
  for (int cycles = 0; cycles < most_cycles; ++cycles) {
    if (condition()) return true;
    idle_for(world, cycle_seconds / 2);
  }
  return condition();
}
inline bool is_enabled_in_time(ServoDriveWorld& world) {
  return await(world, [&world] { return state_of(world).enabled; });
}
inline bool is_reached_in_time(ServoDriveWorld& world) {
  return await(world, [&world] { return state_of(world).target_reached; });
}
inline bool is_homed_in_time(ServoDriveWorld& world) {
  return await(world, [&world] { return state_of(world).homing == ServoHoming::homed; });
}
inline bool has_failed_in_time(ServoDriveWorld& world) {
  return await(world, [&world] { return state_of(world).homing == ServoHoming::failed; });
}

inline bool is_at(ServoDriveWorld& world, double position) {
  return std::abs(state_of(world).position - position) <= tolerance;
}
/// It is where it was half a second ago, and enabled.
inline bool holds(ServoDriveWorld& world) {
  const double rest = state_of(world).position;
  idle_for(world, 0.5);
  return is_at(world, rest) && state_of(world).velocity == 0 && state_of(world).enabled;
}

// ---- with a profile of the drive's own, and halts: profile_cases.cpp

Verdict goes_to_targets_and_says_when_it_is_there(ServoDriveWorld& world);
Verdict an_axis_that_sticks_on_its_way_is_a_fault(ServoDriveWorld& world);
Verdict an_axis_that_sticks_on_a_short_way_is_a_fault(ServoDriveWorld& world);
Verdict an_axis_that_takes_its_time_is_none(ServoDriveWorld& world);
Verdict an_axis_that_turns_is_not_behind(ServoDriveWorld& world);
Verdict goes_as_fast_as_it_was_told(ServoDriveWorld& world);
Verdict a_new_target_replaces_the_one_before(ServoDriveWorld& world);
Verdict keeps_targets_to_its_range(ServoDriveWorld& world);
Verdict has_no_target_after_it_was_off(ServoDriveWorld& world);
Verdict follows_only_what_its_mode_takes(ServoDriveWorld& world);
Verdict comes_to_velocities_and_says_when_it_has_them(ServoDriveWorld& world);
Verdict a_speed_that_is_not_above_zero_is_a_fault(ServoDriveWorld& world);
Verdict halts_on_its_way_to_a_position(ServoDriveWorld& world);
Verdict halts_on_its_way_to_a_target(ServoDriveWorld& world);
Verdict halts_from_a_velocity(ServoDriveWorld& world);

// ---- homing: homing_cases.cpp

Verdict needs_no_home_with_method_0(ServoDriveWorld& world);
Verdict finds_its_home_and_goes_on_in_its_mode(ServoDriveWorld& world);
Verdict is_not_sent_home_while_it_is_off(ServoDriveWorld& world);
Verdict ignores_commands_while_it_homes(ServoDriveWorld& world);
Verdict can_be_homed_again_out_of_a_motion(ServoDriveWorld& world);
Verdict a_halted_homing_has_failed(ServoDriveWorld& world);
Verdict a_homing_without_permission_has_failed(ServoDriveWorld& world);
Verdict tells_why_it_found_no_home(ServoDriveWorld& world);

/// In a world of its own for each order.
Verdict no_order_of_events_moves_it(MakeServoDriveWorld make, ServoMode mode);

}  // namespace flexrf::servo_drive_cases
