// Modes in which the drive makes the profile, and halts in all of them.
#include <algorithm>
#include <string_view>

#include "hal/servo_drive/conformance/servo_drive_cases.hpp"

namespace flexrf::servo_drive_cases {
namespace {

// Moves there and is told so, only once it is there.
bool goes_to(ServoDriveWorld& world, double position, double speed = ServoDrive::full_speed) {
  bool reached_at_once = false;
  do_once(world, [&](ServoDrive& drive) {
    drive.move_to(position, speed);
    reached_at_once = state_of(world).target_reached;
  });
  return !reached_at_once && is_reached_in_time(world) && is_at(world, position);
}

// In so long; a drive has its own following error window, and what it looks at there is its own.
Verdict is_a_fault_within(ServoDriveWorld& world, double duration) {
  idle_for(world, duration);
  const Status& fault = world.drive().fault();
  return verdict(fault.code() == StatusCode::device_fault &&
                 std::string_view{fault.cause()}.find("from its target") != std::string_view::npos &&
                 !state_of(world).enabled);
}

// It was on its way, and now it is at rest for good, without its target.
bool came_to_rest(ServoDriveWorld& world) {
  idle_for(world, 1);
  return holds(world) && !state_of(world).target_reached && world.drive().fault().is_ok();
}

}  // namespace

// [servo-drive-1] [servo-drive-26]
Verdict goes_to_targets_and_says_when_it_is_there(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world)) return Verdict::failed;
  idle_for(world, 0.3);
  if (state_of(world).target_reached || !is_at(world, start)) return Verdict::failed;
  for (const double target : {4.0, -3.0, -3.0}) {
    if (!goes_to(world, target)) return Verdict::failed;
  }
  return verdict(holds(world) && state_of(world).target_reached);
}

// [servo-drive-19]
Verdict an_axis_that_sticks_on_its_way_is_a_fault(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world)) return Verdict::failed;
  do_once(world, [](ServoDrive& drive) { drive.move_to(9, 4); });
  idle_for(world, 0.5);
  if (!world.stick_axis()) return Verdict::skipped;
  return is_a_fault_within(world, 3);
}

// Far less than it may be behind in other modes.
// [servo-drive-19]
Verdict an_axis_that_sticks_on_a_short_way_is_a_fault(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world)) return Verdict::failed;
  if (!world.stick_axis()) return Verdict::skipped;
  do_once(world, [](ServoDrive& drive) { drive.move_to(start + 0.5); });
  return is_a_fault_within(world, 2);
}

// A creeping one, one that turns round at its full speed, one that is where it is sent, and one that was
// halted.
// [servo-drive-24]
Verdict an_axis_that_takes_its_time_is_none(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world)) return Verdict::failed;
  if (!goes_to(world, start + 1, 0.2)) return Verdict::failed;
  do_once(world, [](ServoDrive& drive) { drive.move_to(9.9); });
  idle_for(world, 0.4);
  if (!goes_to(world, -9)) return Verdict::failed;
  idle_for(world, 5);
  do_once(world, [](ServoDrive& drive) { drive.move_to(9, 2); });
  idle_for(world, 1);
  do_once(world, [](ServoDrive& drive) { drive.halt(); });
  idle_for(world, 5);
  return verdict(world.drive().fault().is_ok() && goes_to(world, 9));
}

// However long it turns, and however often the other way.
// [servo-drive-24]
Verdict an_axis_that_turns_is_not_behind(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world)) return Verdict::failed;
  for (const double velocity : {20.0, -20.0, 3.0, 0.0, -20.0}) {
    drive_for(world, velocity, 3);
    if (!world.drive().fault().is_ok()) return Verdict::failed;
  }
  return Verdict::passed;
}

// [servo-drive-13]
Verdict goes_as_fast_as_it_was_told(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world)) return Verdict::failed;
  do_once(world, [](ServoDrive& drive) { drive.move_to(4, 2); });
  double fastest = 0;
  const bool reached = await(world, [&] {
    fastest = std::max(fastest, std::abs(state_of(world).velocity));
    return state_of(world).target_reached;
  });
  return verdict(reached && is_at(world, 4) && fastest > 1 && fastest <= 2 + tolerance);
}

// [servo-drive-12]
Verdict a_new_target_replaces_the_one_before(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world)) return Verdict::failed;
  do_once(world, [](ServoDrive& drive) { drive.move_to(9, 4); });
  idle_for(world, 0.3);
  if (state_of(world).target_reached || state_of(world).position <= start) return Verdict::failed;
  return verdict(goes_to(world, -2));
}

Verdict keeps_targets_to_its_range(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world)) return Verdict::failed;
  do_once(world, [](ServoDrive& drive) { drive.move_to(1e9); });
  if (!is_reached_in_time(world) || !is_at(world, 10)) return Verdict::failed;
  do_once(world, [](ServoDrive& drive) { drive.move_to(-1e9); });
  return verdict(is_reached_in_time(world) && is_at(world, -10) && world.drive().fault().is_ok());
}

// [servo-drive-4]
Verdict has_no_target_after_it_was_off(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world)) return Verdict::failed;
  do_once(world, [](ServoDrive& drive) { drive.move_to(9, 4); });
  idle_for(world, 0.3);
  world.drive().set_inhibited(true);
  do_for(world, 1, [](ServoDrive& drive) { drive.move_to(9); });
  if (state_of(world).enabled || state_of(world).target_reached) return Verdict::failed;
  const double rest = state_of(world).position;
  world.drive().set_inhibited(false);
  if (!is_enabled_in_time(world) || !holds(world)) return Verdict::failed;
  return verdict(rest < 9 - tolerance && is_at(world, rest) && !state_of(world).target_reached &&
                 goes_to(world, 0));
}

// In mode profile_position.
// [servo-drive-4]
Verdict follows_only_what_its_mode_takes(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world)) return Verdict::failed;
  do_for(world, 0.3, [](ServoDrive& drive) {
    drive.command_position(5);
    drive.command_velocity(3);
  });
  return verdict(is_at(world, start) && world.drive().fault().is_ok() && goes_to(world, 4));
}

// [servo-drive-1] [servo-drive-26]
Verdict comes_to_velocities_and_says_when_it_has_them(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world)) return Verdict::failed;
  for (const double velocity : {2.0, -4.0, 0.0}) {
    bool reached_at_once = false;
    do_once(world, [&](ServoDrive& drive) {
      drive.command_velocity(velocity);
      reached_at_once = state_of(world).target_reached;
    });
    const bool reached = await(world, [&] {
      do_once(world, [velocity](ServoDrive& drive) { drive.command_velocity(velocity); });
      return state_of(world).target_reached;
    });
    if (reached_at_once || !reached) return Verdict::failed;
    if (std::abs(state_of(world).velocity - velocity) > tolerance) return Verdict::failed;
  }
  return verdict(holds(world));
}

// [servo-drive-6]
Verdict a_speed_that_is_not_above_zero_is_a_fault(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world)) return Verdict::failed;
  do_once(world, [](ServoDrive& drive) { drive.move_to(4, 0); });
  idle_for(world, 0.5);
  return verdict(world.drive().fault().code() == StatusCode::invalid_argument && is_at(world, start));
}

// [servo-drive-17]
Verdict halts_on_its_way_to_a_position(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world)) return Verdict::failed;
  command_for(world, 9, 0.1);
  do_once(world, [](ServoDrive& drive) { drive.halt(); });
  if (!came_to_rest(world) || state_of(world).position >= 9 - tolerance) return Verdict::failed;
  command_for(world, -2, 2);
  return verdict(is_at(world, -2));
}

// [servo-drive-1] [servo-drive-17] [servo-drive-25] [servo-drive-26]
Verdict halts_on_its_way_to_a_target(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world)) return Verdict::failed;
  do_once(world, [](ServoDrive& drive) { drive.move_to(9, 4); });
  idle_for(world, 0.3);
  if (state_of(world).following_error != 0) return Verdict::failed;
  do_once(world, [](ServoDrive& drive) { drive.halt(); });
  if (!came_to_rest(world)) return Verdict::failed;
  if (state_of(world).position <= start || state_of(world).position >= 9 - tolerance) return Verdict::failed;
  return verdict(goes_to(world, -2));
}

// In both modes that take velocities.
// [servo-drive-17]
Verdict halts_from_a_velocity(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world)) return Verdict::failed;
  drive_for(world, -4, 0.3);
  do_once(world, [](ServoDrive& drive) { drive.halt(); });
  if (!came_to_rest(world) || state_of(world).position >= start) return Verdict::failed;
  const double rest = state_of(world).position;
  drive_for(world, 3, 0.3);
  return verdict(state_of(world).position > rest + 0.3);
}

}  // namespace flexrf::servo_drive_cases
