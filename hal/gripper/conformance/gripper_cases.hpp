// What the cases of the suite have in common: a unit's steps, and what it waits for.
#pragma once

#include <cmath>

#include "hal/gripper/conformance/gripper_conformance.hpp"
#include "tests/verdict.hpp"

namespace flexrf::gripper_cases {

// By the world's clock, for what must happen sooner or later: a loaded machine takes long.
inline constexpr Duration patience = std::chrono::seconds(40);
inline constexpr double tolerance = 1.5e-3;  // m
inline constexpr double opened = GripperSetting::open_width;
inline constexpr double closed = GripperSetting::closed_width;

/// Some cycles at least, also when the machine stands still meanwhile: what was said before goes out in them.
inline void idle_for(GripperWorld& world, Duration duration) {
  int cycles = 10;
  for (const Time start = world.now(); world.now() - start < duration || cycles > 0; --cycles) {
    world.receive();
    world.send();
  }
}

template <class Condition>
inline bool until(GripperWorld& world, const Condition& is_so) {
  for (const Time start = world.now(); world.now() - start < patience;) {
    world.receive();
    const bool so = is_so();
    world.send();
    if (so) return true;
  }
  return false;
}

/// What the driver said last has come to the far end, however long the line takes on a loaded machine.
inline bool is_heard(GripperWorld& world) {
  idle_for(world, std::chrono::milliseconds(100));
  const std::uint64_t before = world.exchanges();
  return before == 0 || until(world, [&] { return world.exchanges() - before >= 6; });
}

/// In the middle of a cycle, as a unit does.
template <class Act>
inline void act(GripperWorld& world, const Act& what) {
  world.receive();
  what(world.gripper());
  world.send();
}

inline bool near(double one, double other) {
  return std::abs(one - other) <= tolerance;
}
inline bool fingers_at(GripperWorld& world, double opening) {
  return near(world.fingers(), opening);
}

inline bool rests(GripperWorld& world) {
  const auto state = world.gripper().state();
  return state && !state->moving;
}
inline GripperObject object(GripperWorld& world) {
  const auto state = world.gripper().state();
  return state ? state->object : GripperObject::unknown;
}
inline bool comes_to_rest(GripperWorld& world) {
  return until(world, [&] { return rests(world); });
}

inline bool is_activated(GripperWorld& world) {
  const auto state = world.gripper().state();
  return state && state->activated && !state->moving;
}

inline bool becomes_active(GripperWorld& world) {
  if (!until(world, [&] { return world.gripper().state().has_value(); })) return false;
  act(world, [](Gripper& gripper) { gripper.activate(); });
  return until(world, [&] { return is_activated(world); });
}

inline bool starts_active(GripperWorld& world, const GripperSetting& setting = {}) {
  return world.start(setting).is_ok() && becomes_active(world);
}

inline bool goes_to(GripperWorld& world, double opening) {
  act(world, [&](Gripper& gripper) { gripper.command({.opening = opening}); });
  return comes_to_rest(world);
}

// ---- the cases

Verdict does_nothing_by_itself(GripperWorld& world);
Verdict follows_once_it_is_activated(GripperWorld& world);
Verdict activated_again_it_stays_as_it_is(GripperWorld& world);
Verdict opens_and_closes(GripperWorld& world);
Verdict moves_from_the_command_on(GripperWorld& world);
Verdict goes_in_between_or_refuses(GripperWorld& world);
Verdict says_what_it_does_not_do(GripperWorld& world);
Verdict keeps_to_its_reach(GripperWorld& world);
template <int Which>
Verdict nonsense_is_a_fault_and_never_followed(GripperWorld& world);
Verdict slower_takes_longer(GripperWorld& world);
Verdict tells_an_object_it_gripped(GripperWorld& world);
Verdict tells_a_hollow_object(GripperWorld& world);
Verdict tells_an_object_that_is_lost(GripperWorld& world);
Verdict a_new_goal_replaces_the_one_before(GripperWorld& world);
Verdict halts_or_goes_on_to_its_end(GripperWorld& world);
Verdict halted_it_holds_what_it_holds(GripperWorld& world);
Verdict inhibited_it_ends_its_motion_and_forgets(GripperWorld& world);
Verdict made_safe_it_holds_what_it_holds(GripperWorld& world);
Verdict made_safe_it_releases_where_it_shall(GripperWorld& world);
template <GripperFarEnd Behaviour>
Verdict made_safe_while_it_is_not_heard_it_confirms_nothing(GripperWorld& world);
/// In a world of its own for each order.
Verdict no_order_of_events_moves_it(MakeGripperWorld make);
Verdict fingers_that_do_not_move_are_told(GripperWorld& world);
template <GripperFarEnd Behaviour>
Verdict is_heard_again(GripperWorld& world);
Verdict without_power_it_is_no_longer_activated(GripperWorld& world);
Verdict its_own_fault_is_told_and_ended_by_activation(GripperWorld& world);
Verdict switches_that_contradict_are_told(GripperWorld& world);

}  // namespace flexrf::gripper_cases
