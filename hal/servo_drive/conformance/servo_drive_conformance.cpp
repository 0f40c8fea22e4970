#include "hal/servo_drive/conformance/servo_drive_conformance.hpp"

#include <algorithm>
#include <limits>
#include <string_view>
#include <utility>

#include "hal/servo_drive/conformance/servo_drive_cases.hpp"
#include "hal/servo_drive/interface/servo_restraints.hpp"
#include "tests/conformance.hpp"

namespace flexrf {
namespace {

using namespace servo_drive_cases;
using enum ServoMode;

MakeServoDriveWorld make_world = nullptr;

// Each case runs in here, so that a failing assertion jumps over no destructor.
enum class Range { limited, endless, modulo };
constexpr double whole_turn = 6;

template <Verdict (*Run)(ServoDriveWorld&), ServoMode Mode = cyclic_position, bool NeedsHome = false,
          Range Of = Range::limited>
void judged(void**) {
  Verdict result = Verdict::failed;
  {
    const std::unique_ptr<ServoDriveWorld> world =
        make_world({.mode = Mode,
                    .needs_home = NeedsHome,
                    .endless = Of != Range::limited,
                    .modulo = Of == Range::modulo ? whole_turn : 0});
    result = Run(*world);
    if (result == Verdict::failed) {
      print_message("fault: %s; homing: %s\n", world->drive().fault().cause(),
                    world->drive().homing_problem().cause());
    }
  }
  conclude(result);
}

// [servo-drive-3] [servo-drive-4] [servo-drive-20]
template <ServoMode Mode>
void holds_in_all_orders(void**) {
  conclude(no_order_of_events_moves_it(make_world, Mode));
}

// [servo-drive-2]
Verdict enables_itself_where_it_is(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world)) return Verdict::failed;
  idle_for(world, 0.5);
  return verdict(is_at(world, start) && world.drive().state()->velocity == 0 &&
                 world.drive().fault().is_ok());
}

// [servo-drive-8] [servo-drive-26]
Verdict follows_positions_and_holds(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world)) return Verdict::failed;
  command_for(world, 4, 1);
  if (!is_at(world, 4) || state_of(world).target_reached) return Verdict::failed;
  idle_for(world, 0.5);  // the last command stands
  return verdict(is_at(world, 4) && std::abs(world.drive().state()->following_error) <= tolerance);
}

// [servo-drive-9]
Verdict goes_no_faster_than_it_may(ServoDriveWorld& world) {
  if (!world.shares_its_cycle()) return Verdict::skipped;
  if (!is_enabled_in_time(world)) return Verdict::failed;
  double before = world.drive().state()->position;
  for (int cycles = 0; cycles < 300; ++cycles) {
    command_for(world, cycles < 100 ? 9 : -9, cycle_seconds / 2);
    const auto state = world.drive().state();
    if (!state || std::abs(state->position - before) > 20 * cycle_seconds + tolerance) return Verdict::failed;
    before = state->position;
  }
  return verdict(is_at(world, -9));
}

// A jump is approached in each cycle by no other velocity than the one before and what the acceleration makes
// of it, and is not passed.
// [servo-drive-27]
Verdict keeps_to_its_acceleration(ServoDriveWorld& world) {
  if (!world.shares_its_cycle()) return Verdict::skipped;
  if (!is_enabled_in_time(world)) return Verdict::failed;
  constexpr double counted = 2 * tolerance / cycle_seconds;  // what increments make of a velocity
  double before = world.drive().state()->position;
  double velocity = 0;
  double farthest = before;
  for (int cycles = 0; cycles < 300; ++cycles) {
    const bool back = cycles > 40 && cycles < 60;
    command_for(world, back ? -9 : 9, cycle_seconds / 2);
    const auto state = world.drive().state();
    if (!state) return Verdict::failed;
    const double now = (state->position - before) / cycle_seconds;
    if (std::abs(now - velocity) > acceleration * cycle_seconds + 2 * counted) return Verdict::failed;
    velocity = now;
    before = state->position;
    farthest = std::max(farthest, before);
  }
  return verdict(is_at(world, 9) && farthest <= 9 + tolerance);
}

// [servo-drive-9]
Verdict keeps_to_its_range(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world)) return Verdict::failed;
  command_for(world, 1e9, 2);
  if (!is_at(world, 10)) return Verdict::failed;
  command_for(world, -1e9, 3);
  return verdict(is_at(world, -10) && world.drive().fault().is_ok());
}

// [servo-drive-11] [servo-drive-25]
Verdict follows_velocities(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world)) return Verdict::failed;
  drive_for(world, -2, 1);
  const auto state = world.drive().state();
  if (!state || std::abs(state->velocity + 2) > tolerance || state->position > 0) return Verdict::failed;
  if (state->following_error != 0) return Verdict::failed;
  drive_for(world, 0, 1);
  const double rest = world.drive().state()->position;
  idle_for(world, 0.5);
  return verdict(is_at(world, rest) && world.drive().state()->velocity == 0);
}

// [servo-drive-11]
Verdict ends_velocities_at_the_end_of_its_range(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world)) return Verdict::failed;
  for (int part = 0; part < 50; ++part) {
    drive_for(world, 4, 0.1);
    const auto state = world.drive().state();
    if (!state || state->position > 10 + tolerance) return Verdict::failed;
  }
  const auto state = world.drive().state();
  return verdict(state->velocity == 0 && is_at(world, 10));
}

// [servo-drive-3] [servo-drive-4] [exec-73]
Verdict an_inhibited_drive_is_off_and_forgets(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world)) return Verdict::failed;
  command_for(world, 9, 0.1);
  world.drive().set_inhibited(true);
  command_for(world, 9, 0.5);
  static_cast<void>(world.drive().take_restraint());
  command_for(world, 11, 0.5);
  if (world.drive().take_restraint().reason != nullptr) return Verdict::failed;
  const auto state = world.drive().state();
  if (!state || state->enabled || state->velocity != 0) return Verdict::failed;
  const double rest = state->position;
  world.drive().set_inhibited(false);
  if (!is_enabled_in_time(world)) return Verdict::failed;
  idle_for(world, 0.5);
  return verdict(rest < 9 - tolerance && is_at(world, rest));
}

// [servo-drive-6]
template <int Which>
Verdict nonsense_is_a_fault_and_never_followed(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world)) return Verdict::failed;
  using Limits = std::numeric_limits<double>;
  command_for(world, Which == 0 ? Limits::quiet_NaN() : Limits::infinity(), 0.3);
  idle_for(world, 0.3);
  return verdict(world.drive().fault().code() == StatusCode::invalid_argument && is_at(world, start));
}

// [servo-drive-20]
Verdict can_be_made_safe(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world)) return Verdict::failed;
  command_for(world, 9, 0.1);
  for (int cycles = 0; cycles < 300; ++cycles) {
    idle_for(world, cycle_seconds / 2);
    if (!world.drive().make_safe()) continue;
    world.drive().set_inhibited(true);
    const auto state = world.drive().state();
    if (!state) return Verdict::failed;
    const double rest = state->position;
    idle_for(world, 0.3);
    return verdict(is_at(world, rest) && !world.drive().state()->enabled);
  }
  return Verdict::failed;
}

// [servo-drive-7]
Verdict says_nothing_when_it_is_not_heard(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world)) return Verdict::failed;
  if (!world.lose_drive()) return Verdict::skipped;
  idle_for(world, 0.5);
  return verdict(!world.drive().state());
}

// What it does with its next command, as the operator reads it; null: all of it.
template <class Command>
const char* reason_after(ServoDriveWorld& world, Command command) {
  idle_for(world, cycle_seconds / 2);
  static_cast<void>(world.drive().take_restraint());
  do_once(world, command);
  return world.drive().take_restraint().reason;
}

// Said in this cycle without a command in it.
const char* reason_in_force(ServoDriveWorld& world) {
  return reason_after(world, [](ServoDrive&) {});
}

// [servo-drive-5]
Verdict says_what_it_holds_back(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world)) return Verdict::failed;
  using namespace servo_restraints;
  return verdict(reason_after(world, [](ServoDrive& drive) { drive.command_position(1.1); }) == nullptr &&
                 reason_after(world, [](ServoDrive& drive) { drive.command_position(11); }) == out_of_range &&
                 reason_in_force(world) == out_of_range &&
                 reason_after(world, [](ServoDrive& drive) { drive.command_velocity(1); }) == another_mode &&
                 reason_after(world, [](ServoDrive& drive) { drive.move_to(2); }) == another_mode &&
                 reason_after(world, [](ServoDrive& drive) { drive.home(); }) == no_homing);
}

// At 20 a second it may go 0.14 in a cycle.
// [servo-drive-5]
Verdict says_that_it_is_led_too_fast(ServoDriveWorld& world) {
  if (!world.shares_its_cycle()) return Verdict::skipped;
  if (!is_enabled_in_time(world)) return Verdict::failed;
  static_cast<void>(world.drive().take_restraint());
  double wanted = start;
  double speed = 0;
  const auto lead = [&](double towards, int cycles) {
    Restraint said;
    for (int i = 0; i < cycles; ++i) {
      speed += std::clamp(towards - speed, -acceleration * cycle_seconds, acceleration * cycle_seconds);
      wanted += speed * cycle_seconds;
      command_for(world, wanted, cycle_seconds / 2);
      if (const Restraint now = world.drive().take_restraint(); now.reason != nullptr) said = now;
    }
    return said;
  };
  // As fast as it may, to either side, with what sums of such steps leave over.
  if (lead(20, 40).reason != nullptr || lead(-20, 80).reason != nullptr) return Verdict::failed;
  const Restraint fast = lead(-30, 40);
  const bool counts = fast.reason == servo_restraints::led_too_fast && fast.asked < fast.given - 0.14;
  // While it makes up for it, and no longer.
  speed = 0;
  if (!counts || lead(0, 2).reason != servo_restraints::led_too_fast) return Verdict::failed;
  idle_for(world, 1);
  static_cast<void>(world.drive().take_restraint());
  return verdict(lead(0, 20).reason == nullptr && is_at(world, wanted) && world.drive().fault().is_ok());
}

// [servo-drive-5]
Verdict says_as_long_as_it_lasts_that_it_turns_no_faster(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world)) return Verdict::failed;
  using namespace servo_restraints;
  if (reason_after(world, [](ServoDrive& drive) { drive.command_velocity(-25); }) != too_fast)
    return Verdict::failed;
  for (int cycles = 0; cycles < 20; ++cycles) {
    if (reason_in_force(world) != too_fast) return Verdict::failed;
  }
  if (reason_after(world, [](ServoDrive& drive) { drive.command_velocity(-20); }) != nullptr)
    return Verdict::failed;
  if (reason_after(world, [](ServoDrive& drive) { drive.command_velocity(-25); }) != too_fast)
    return Verdict::failed;
  return verdict(reason_after(world, [](ServoDrive& drive) { drive.halt(); }) == nullptr &&
                 reason_in_force(world) == nullptr);
}

// [servo-drive-5] [servo-drive-13]
Verdict says_that_it_goes_no_faster(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world)) return Verdict::failed;
  using namespace servo_restraints;
  return verdict(reason_after(world, [](ServoDrive& drive) { drive.move_to(2, 3); }) == nullptr &&
                 reason_after(world, [](ServoDrive& drive) { drive.move_to(3, 21); }) == too_fast &&
                 reason_in_force(world) == too_fast && is_reached_in_time(world) &&
                 reason_in_force(world) == nullptr &&
                 reason_after(world, [](ServoDrive& drive) { drive.move_to(-11); }) == out_of_range &&
                 reason_after(world, [](ServoDrive& drive) { drive.command_position(1); }) == another_mode);
}

// Where it is commanded to in the mode that it is in.
void send_to(ServoDriveWorld& world, double position, bool cyclic) {
  if (cyclic) {
    command_for(world, position, 3);
  } else {
    do_once(world, [position](ServoDrive& drive) { drive.move_to(position, 10); });
    static_cast<void>(is_reached_in_time(world));
  }
}

// [servo-drive-10]
template <bool Cyclic>
Verdict an_endless_axis_goes_anywhere(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world)) return Verdict::failed;
  for (const double far : {25.0, -25.0}) {
    send_to(world, far, Cyclic);
    if (!is_at(world, far) || reason_in_force(world) != nullptr) return Verdict::failed;
  }
  return verdict(world.drive().fault().is_ok());
}

// From 1 to 5 it is nearer through 0, which is 6 as well; and 13 is 1.
// [servo-drive-10]
template <bool Cyclic>
Verdict a_modulo_axis_goes_the_shorter_way(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world)) return Verdict::failed;
  for (const auto& [asked, told] : {std::pair{5.0, 5.0}, std::pair{13.0, 1.0}, std::pair{-1.0, 5.0}}) {
    if (!Cyclic) do_once(world, [to = asked](ServoDrive& drive) { drive.move_to(to, 10); });
    for (int cycles = 0; cycles < 150; ++cycles) {
      if (Cyclic) command_for(world, asked, cycle_seconds / 2);
      if (!Cyclic) idle_for(world, cycle_seconds / 2);
      const double position = state_of(world).position;
      const bool is_on_the_shorter_way = position < 1 + tolerance || position > 5 - tolerance;
      if (position < 0 || position >= whole_turn || !is_on_the_shorter_way) return Verdict::failed;
    }
    if (!is_at(world, told)) return Verdict::failed;
  }
  return verdict(world.drive().fault().is_ok());
}

// [servo-drive-19]
Verdict an_axis_that_sticks_is_a_fault(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world)) return Verdict::failed;
  if (!world.stick_axis()) return Verdict::skipped;
  command_for(world, 9, 1);
  const Status& fault = world.drive().fault();
  return verdict(fault.code() == StatusCode::device_fault &&
                 std::string_view{fault.cause()}.find("behind") != std::string_view::npos &&
                 !state_of(world).enabled);
}

// [servo-drive-19]
Verdict a_jam_while_it_turns_is_a_fault(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world)) return Verdict::failed;
  drive_for(world, 2, 0.5);
  if (!world.drive().fault().is_ok()) return Verdict::failed;
  if (!world.stick_axis()) return Verdict::skipped;
  drive_for(world, 2, 3.5);
  const Status& fault = world.drive().fault();
  return verdict(fault.code() == StatusCode::device_fault &&
                 std::string_view{fault.cause()}.find("behind") != std::string_view::npos &&
                 !state_of(world).enabled);
}

// [servo-drive-21]
Verdict reports_a_tripped_drive(ServoDriveWorld& world) {
  if (!is_enabled_in_time(world)) return Verdict::failed;
  if (!world.trip_drive()) return Verdict::skipped;
  idle_for(world, 0.3);
  const Status& fault = world.drive().fault();
  return verdict(fault.code() == StatusCode::device_fault && fault.cause()[0] != '\0');
}

CMUnitTest test(const char* name, CMUnitTestFunction run) {
  return {name, run, nullptr, nullptr, nullptr};
}

}  // namespace

int run_servo_drive_conformance(const char* driver, MakeServoDriveWorld make) {
  make_world = make;
  const CMUnitTest tests[] = {
      test("enables itself where it is", judged<enables_itself_where_it_is>),
      test("follows positions and holds the last", judged<follows_positions_and_holds>),
      test("goes no faster than it may", judged<goes_no_faster_than_it_may>),
      test("keeps to its range", judged<keeps_to_its_range>),
      test("follows velocities", judged<follows_velocities, cyclic_velocity>),
      test("ends velocities at the end of its range",
           judged<ends_velocities_at_the_end_of_its_range, cyclic_velocity>),
      test("is off while inhibited and forgets", judged<an_inhibited_drive_is_off_and_forgets>),
      test("never follows what is no number", judged<nonsense_is_a_fault_and_never_followed<0>>),
      test("never follows what is infinite", judged<nonsense_is_a_fault_and_never_followed<1>>),
      test("can be made safe", judged<can_be_made_safe>),
      test("no order of events moves it, cyclic position", holds_in_all_orders<cyclic_position>),
      test("no order of events moves it, cyclic velocity", holds_in_all_orders<cyclic_velocity>),
      test("no order of events moves it, profile position", holds_in_all_orders<profile_position>),
      test("is silent when it is not heard", judged<says_nothing_when_it_is_not_heard>),
      test("keeps to its acceleration", judged<keeps_to_its_acceleration>),
      test("says what it holds back", judged<says_what_it_holds_back>),
      test("says that it is led too fast", judged<says_that_it_is_led_too_fast>),
      test("says that it turns no faster, cyclic",
           judged<says_as_long_as_it_lasts_that_it_turns_no_faster, cyclic_velocity>),
      test("says that it turns no faster, by its profile",
           judged<says_as_long_as_it_lasts_that_it_turns_no_faster, profile_velocity>),
      test("says that it goes no faster", judged<says_that_it_goes_no_faster, profile_position>),
      test("endless, goes anywhere",
           judged<an_endless_axis_goes_anywhere<true>, cyclic_position, false, Range::endless>),
      test("endless, goes to targets anywhere",
           judged<an_endless_axis_goes_anywhere<false>, profile_position, false, Range::endless>),
      test("modulo, goes the shorter way",
           judged<a_modulo_axis_goes_the_shorter_way<true>, cyclic_position, false, Range::modulo>),
      test("modulo, goes to targets the shorter way",
           judged<a_modulo_axis_goes_the_shorter_way<false>, profile_position, false, Range::modulo>),
      test("is in fault when its axis sticks", judged<an_axis_that_sticks_is_a_fault>),
      test("is in fault when it jams, cyclic velocity",
           judged<a_jam_while_it_turns_is_a_fault, cyclic_velocity>),
      test("is in fault when it jams, profile velocity",
           judged<a_jam_while_it_turns_is_a_fault, profile_velocity, false, Range::modulo>),
      test("is in fault when it sticks on its way",
           judged<an_axis_that_sticks_on_its_way_is_a_fault, profile_position>),
      test("is in fault when it sticks on a short way",
           judged<an_axis_that_sticks_on_a_short_way_is_a_fault, profile_position>),
      test("is in no fault when it takes its time",
           judged<an_axis_that_takes_its_time_is_none, profile_position>),
      test("is not behind while it turns, cyclic velocity",
           judged<an_axis_that_turns_is_not_behind, cyclic_velocity, false, Range::endless>),
      test("is not behind while it turns, profile velocity",
           judged<an_axis_that_turns_is_not_behind, profile_velocity, false, Range::modulo>),
      test("reports a tripped drive", judged<reports_a_tripped_drive>),
      test("goes to targets", judged<goes_to_targets_and_says_when_it_is_there, profile_position>),
      test("goes as fast as it was told", judged<goes_as_fast_as_it_was_told, profile_position>),
      test("a new target replaces", judged<a_new_target_replaces_the_one_before, profile_position>),
      test("keeps targets to its range", judged<keeps_targets_to_its_range, profile_position>),
      test("forgets its target when off", judged<has_no_target_after_it_was_off, profile_position>),
      test("follows only what its mode takes", judged<follows_only_what_its_mode_takes, profile_position>),
      test("a speed is above zero", judged<a_speed_that_is_not_above_zero_is_a_fault, profile_position>),
      test("comes to velocities", judged<comes_to_velocities_and_says_when_it_has_them, profile_velocity>),
      test("ends profiles at the end of its range",
           judged<ends_velocities_at_the_end_of_its_range, profile_velocity>),
      test("reports a trip on its way", judged<reports_a_tripped_drive, profile_position>),
      test("halts, cyclic position", judged<halts_on_its_way_to_a_position>),
      test("halts, cyclic velocity", judged<halts_from_a_velocity, cyclic_velocity>),
      test("halts, profile position", judged<halts_on_its_way_to_a_target, profile_position>),
      test("halts, profile velocity", judged<halts_from_a_velocity, profile_velocity>),
      test("needs no home with method 0", judged<needs_no_home_with_method_0>),
      test("homes, cyclic position", judged<finds_its_home_and_goes_on_in_its_mode, cyclic_position, true>),
      test("homes, cyclic velocity", judged<finds_its_home_and_goes_on_in_its_mode, cyclic_velocity, true>),
      test("homes, profile position", judged<finds_its_home_and_goes_on_in_its_mode, profile_position, true>),
      test("homes, profile velocity", judged<finds_its_home_and_goes_on_in_its_mode, profile_velocity, true>),
      test("is not sent home while it is off",
           judged<is_not_sent_home_while_it_is_off, cyclic_position, true>),
      test("ignores commands while it homes",
           judged<ignores_commands_while_it_homes, profile_position, true>),
      test("homes again, positions", judged<can_be_homed_again_out_of_a_motion, cyclic_position, true>),
      test("homes again, targets", judged<can_be_homed_again_out_of_a_motion, profile_position, true>),
      test("homes again, velocities", judged<can_be_homed_again_out_of_a_motion, cyclic_velocity, true>),
      test("a halted homing has failed", judged<a_halted_homing_has_failed, profile_position, true>),
      test("an inhibited homing has failed",
           judged<a_homing_without_permission_has_failed, cyclic_position, true>),
      test("tells why it found no home", judged<tells_why_it_found_no_home, profile_position, true>),
  };
  return cmocka_run_group_tests_name(driver, tests, nullptr, nullptr);
}

}  // namespace flexrf
