// Homing, from whichever mode. The home of a world's axis is at 0.
#include "hal/servo_drive/conformance/servo_drive_cases.hpp"

namespace flexrf::servo_drive_cases {
namespace {

// Whatever it takes in its mode: it moves.
bool moves(ServoDriveWorld& world) {
  const double before = state_of(world).position;
  do_for(world, 0.5, [](ServoDrive& drive) {
    drive.command_position(3);
    drive.command_velocity(3);
  });
  do_once(world, [](ServoDrive& drive) { drive.move_to(3); });
  idle_for(world, 1);
  return state_of(world).position > before + 0.5 && world.drive().fault().is_ok();
}

bool starts_to_home(ServoDriveWorld& world) {
  bool runs_at_once = false;
  do_once(world, [&](ServoDrive& drive) {
    drive.home();
    runs_at_once = state_of(world).homing == ServoHoming::running;
  });
  return runs_at_once;
}

}  // namespace

// [servo-drive-23]
Verdict needs_no_home_with_method_0(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world)) return Verdict::failed;
  if (state_of(world).homing != ServoHoming::homed) return Verdict::failed;
  do_once(world, [](ServoDrive& drive) { drive.home(); });
  return verdict(state_of(world).homing == ServoHoming::homed && holds(world) && is_at(world, start));
}

// [servo-drive-14] [servo-drive-15] [servo-drive-26]
Verdict finds_its_home_and_goes_on_in_its_mode(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world)) return Verdict::failed;
  if (state_of(world).homing != ServoHoming::not_homed) return Verdict::failed;
  if (!starts_to_home(world)) return Verdict::failed;
  bool has_reached = false;
  const bool homed = await(world, [&] {
    const ServoState state = state_of(world);
    has_reached = has_reached || (state.homing == ServoHoming::running && state.target_reached);
    return state.homing == ServoHoming::homed;
  });
  if (!homed || has_reached) return Verdict::failed;
  if (!is_at(world, 0) || !holds(world) || !is_at(world, 0)) return Verdict::failed;
  if (!world.drive().homing_problem().is_ok()) return Verdict::failed;
  return verdict(moves(world) && state_of(world).homing == ServoHoming::homed);
}

// Neither without the permission to move nor while it is on its way to it; and none of it is remembered.
// [servo-drive-4] [servo-drive-22]
Verdict is_not_sent_home_while_it_is_off(ServoDriveWorld& world) {
  world.drive().set_inhibited(true);
  idle_for(world, 0.5);
  if (state_of(world).enabled) return Verdict::failed;
  do_once(world, [](ServoDrive& drive) { drive.home(); });
  if (state_of(world).homing != ServoHoming::not_homed) return Verdict::failed;
  world.drive().set_inhibited(false);
  do_once(world, [](ServoDrive& drive) {
    if (const auto state = drive.state(); state && !state->enabled) drive.home();
  });
  return verdict(is_enabled_in_time(world) && holds(world) && is_at(world, start) &&
                 state_of(world).homing == ServoHoming::not_homed);
}

// [servo-drive-4]
Verdict ignores_commands_while_it_homes(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world) || !starts_to_home(world)) return Verdict::failed;
  for (int cycles = 0; cycles < most_cycles && state_of(world).homing == ServoHoming::running; ++cycles) {
    if (!state_of(world).enabled) return Verdict::failed;
    // As long as it runs, whatever the drive is about.
    world.receive(cycle);
    if (state_of(world).homing == ServoHoming::running) {
      world.drive().command_position(5);
      world.drive().command_velocity(5);
      world.drive().move_to(5);
      world.drive().home();
    }
    world.send();
  }
  if (state_of(world).homing != ServoHoming::homed) return Verdict::failed;
  return verdict(holds(world) && is_at(world, 0));
}

// [servo-drive-14]
Verdict can_be_homed_again_out_of_a_motion(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world)) return Verdict::failed;
  do_once(world, [](ServoDrive& drive) {
    drive.command_position(9);
    drive.command_velocity(4);
    drive.move_to(9, 4);
  });
  idle_for(world, 0.2);
  for (int runs = 0; runs < 2; ++runs) {
    if (!starts_to_home(world) || !is_homed_in_time(world) || !is_at(world, 0)) return Verdict::failed;
  }
  return verdict(holds(world) && is_at(world, 0));
}

// [servo-drive-14] [servo-drive-16] [servo-drive-18]
Verdict a_halted_homing_has_failed(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world) || !starts_to_home(world)) return Verdict::failed;
  idle_for(world, 0.2);
  do_once(world, [](ServoDrive& drive) { drive.halt(); });
  if (!has_failed_in_time(world) || !holds(world)) return Verdict::failed;
  if (world.drive().homing_problem().is_ok() || !world.drive().fault().is_ok()) return Verdict::failed;
  if (is_at(world, 0)) return Verdict::failed;
  return verdict(starts_to_home(world) && is_homed_in_time(world) && is_at(world, 0));
}

// [servo-drive-14]
Verdict a_homing_without_permission_has_failed(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world) || !starts_to_home(world)) return Verdict::failed;
  idle_for(world, 0.2);
  world.drive().set_inhibited(true);
  idle_for(world, 1);
  if (state_of(world).homing != ServoHoming::failed || state_of(world).enabled) return Verdict::failed;
  const double rest = state_of(world).position;
  world.drive().set_inhibited(false);
  if (!is_enabled_in_time(world) || !holds(world) || !is_at(world, rest)) return Verdict::failed;
  return verdict(world.drive().fault().is_ok() && moves(world));
}

// [servo-drive-14] [servo-drive-15] [servo-drive-16]
Verdict tells_why_it_found_no_home(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world)) return Verdict::failed;
  if (!starts_to_home(world)) return Verdict::failed;
  if (!world.lose_home()) return Verdict::skipped;
  if (!has_failed_in_time(world) || !holds(world)) return Verdict::failed;
  const Status& problem = world.drive().homing_problem();
  return verdict(!problem.is_ok() && problem.cause()[0] != '\0' && world.drive().fault().is_ok() &&
                 moves(world));
}

}  // namespace flexrf::servo_drive_cases
