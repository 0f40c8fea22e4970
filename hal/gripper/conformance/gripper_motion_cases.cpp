#include <algorithm>
#include <limits>

#include "hal/gripper/conformance/gripper_cases.hpp"

namespace flexrf::gripper_cases {

// [gripper-12]
Verdict does_nothing_by_itself(GripperWorld& world) {
  if (!world.start({})) return Verdict::failed;
  const double before = world.fingers();
  if (!until(world, [&] { return world.gripper().state().has_value(); })) return Verdict::failed;
  idle_for(world, std::chrono::milliseconds(300));
  return verdict(world.fingers() == before && rests(world) && world.gripper().trouble().is_ok());
}

// [gripper-6] [gripper-8]
Verdict follows_once_it_is_activated(GripperWorld& world) {
  if (!world.start({})) return Verdict::failed;
  if (!until(world, [&] { return world.gripper().state().has_value(); })) return Verdict::failed;
  if (!world.gripper().state()->activated) {
    const double before = world.fingers();
    act(world, [](Gripper& gripper) { gripper.close(); });
    idle_for(world, std::chrono::milliseconds(300));
    if (world.fingers() != before) return Verdict::failed;
  }
  return verdict(becomes_active(world) && goes_to(world, closed) && fingers_at(world, closed));
}

// Its fingers would go all their way, and drop what they hold.
// [gripper-17]
Verdict activated_again_it_stays_as_it_is(GripperWorld& world) {
  if (!starts_active(world) || !goes_to(world, closed)) return Verdict::failed;
  const double before = world.fingers();
  act(world, [](Gripper& gripper) { gripper.activate(); });
  bool stays = is_activated(world);
  for (const Time start = world.now(); world.now() - start < std::chrono::milliseconds(300);) {
    world.receive();
    stays = stays && world.fingers() == before && is_activated(world);
    world.send();
  }
  return verdict(stays && world.gripper().trouble().is_ok());
}

Verdict opens_and_closes(GripperWorld& world) {
  if (!starts_active(world)) return Verdict::failed;
  for (const double target : {closed, opened, closed, opened}) {
    if (!goes_to(world, target) || !fingers_at(world, target)) return Verdict::failed;
    const auto state = world.gripper().state();
    if (!state || !state->opening || !near(*state->opening, target)) return Verdict::failed;
    const bool tells = world.gripper().capabilities().detects_object;
    if (tells && state->object != GripperObject::none) return Verdict::failed;
  }
  return verdict(world.gripper().trouble().is_ok());
}

// [gripper-4]
Verdict moves_from_the_command_on(GripperWorld& world) {
  if (!starts_active(world) || !goes_to(world, opened)) return Verdict::failed;
  world.receive();
  world.gripper().close();
  const auto state = world.gripper().state();
  world.send();
  return verdict(state && state->moving && state->object == GripperObject::unknown);
}

// [gripper-1] [gripper-9]
Verdict goes_in_between_or_refuses(GripperWorld& world) {
  if (!starts_active(world)) return Verdict::failed;
  if (world.gripper().capabilities().positions)
    return verdict(goes_to(world, 0.05) && fingers_at(world, 0.05) && goes_to(world, 0.06) &&
                   fingers_at(world, 0.06));
  const double before = world.fingers();
  act(world, [](Gripper& gripper) { gripper.command({.opening = 0.05}); });
  idle_for(world, std::chrono::milliseconds(300));
  return verdict(world.gripper().fault().code() == StatusCode::invalid_argument && world.fingers() == before);
}

// [gripper-15]
Verdict says_what_it_does_not_do(GripperWorld& world) {
  if (!starts_active(world)) return Verdict::failed;
  const GripperCapabilities can = world.gripper().capabilities();
  const auto says_so = [&world](const GripperGoal& goal) {
    act(world, [&goal](Gripper& gripper) { gripper.command(goal); });
    return world.gripper().take_restraint().reason != nullptr;
  };
  static_cast<void>(world.gripper().take_restraint());
  if (says_so({.opening = opened}) || !says_so({.opening = 2 * opened})) return Verdict::failed;
  // More than any can, if it has a limit or none at all.
  const bool has_limits =
      (!can.speed || std::isfinite(can.fastest)) && (!can.force || std::isfinite(can.strongest));
  const bool tells = says_so({.opening = opened, .speed = 1e3}) && says_so({.opening = opened, .force = 1e6});
  const bool is_quiet =
      !can.speed || !can.force ||
      !says_so({.opening = opened, .speed = GripperSetting::speed, .force = GripperSetting::force});
  return verdict((tells || !has_limits) && is_quiet && world.gripper().fault().is_ok());
}

// [gripper-2]
Verdict keeps_to_its_reach(GripperWorld& world) {
  if (!starts_active(world) || !goes_to(world, -1) || !fingers_at(world, closed)) return Verdict::failed;
  return verdict(goes_to(world, 1) && fingers_at(world, opened) && world.gripper().fault().is_ok());
}

// [gripper-9]
template <int Which>
Verdict nonsense_is_a_fault_and_never_followed(GripperWorld& world) {
  if (!starts_active(world)) return Verdict::failed;
  const double before = world.fingers();
  using Limits = std::numeric_limits<double>;
  GripperGoal goal;
  if (Which == 0) goal.opening = Limits::quiet_NaN();
  if (Which == 1) goal.speed = Limits::infinity();
  if (Which == 2) goal.force = -1;
  act(world, [&](Gripper& gripper) { gripper.command(goal); });
  idle_for(world, std::chrono::milliseconds(300));
  return verdict(world.gripper().fault().code() == StatusCode::invalid_argument && world.fingers() == before);
}

// [gripper-11]
Verdict slower_takes_longer(GripperWorld& world) {
  if (!starts_active(world) || !goes_to(world, opened)) return Verdict::failed;
  if (!world.gripper().capabilities().speed) return Verdict::skipped;
  const Time start = world.now();
  act(world, [](Gripper& gripper) { gripper.command({.opening = closed, .speed = 0.03}); });
  return verdict(comes_to_rest(world) && seconds(world.now() - start) >= opened / 0.03 * 0.8);
}

// [gripper-1] [gripper-7]
Verdict tells_an_object_it_gripped(GripperWorld& world) {
  if (!starts_active(world) || !goes_to(world, opened)) return Verdict::failed;
  const GripperCapabilities can = world.gripper().capabilities();
  if (!can.detects_object || !world.put_object(0.03)) return Verdict::skipped;
  if (!goes_to(world, closed) || object(world) != GripperObject::gripped) return Verdict::failed;
  const std::optional<double> opening = world.gripper().state()->opening;
  if (can.measures_opening && !(opening && near(*opening, 0.03))) return Verdict::failed;
  if (!can.measures_opening && opening) return Verdict::failed;
  idle_for(world, std::chrono::milliseconds(300));
  if (object(world) != GripperObject::gripped || !world.gripper().trouble().is_ok()) return Verdict::failed;
  return verdict(goes_to(world, opened) && object(world) == GripperObject::none);
}

Verdict tells_a_hollow_object(GripperWorld& world) {
  if (!starts_active(world) || !goes_to(world, closed)) return Verdict::failed;
  const GripperCapabilities can = world.gripper().capabilities();
  if (!can.positions || !can.detects_object || !world.put_around(0.05)) return Verdict::skipped;
  return verdict(goes_to(world, opened) && object(world) == GripperObject::gripped_inside &&
                 fingers_at(world, 0.05));
}

Verdict tells_an_object_that_is_lost(GripperWorld& world) {
  if (!starts_active(world) || !goes_to(world, opened)) return Verdict::failed;
  if (!world.gripper().capabilities().detects_object || !world.put_object(0.03)) return Verdict::skipped;
  if (!goes_to(world, closed) || object(world) != GripperObject::gripped) return Verdict::failed;
  world.take_away();
  if (!until(world, [&] { return object(world) == GripperObject::lost && fingers_at(world, closed); }))
    return Verdict::failed;
  return verdict(goes_to(world, opened) && object(world) == GripperObject::none);
}

namespace {

// Commanded, and then halted, or as good as, before it can have arrived.
template <class Stop>
Verdict ends_its_motion(GripperWorld& world, const Stop& stop) {
  if (!starts_active(world) || !goes_to(world, opened)) return Verdict::failed;
  act(world, [](Gripper& gripper) { gripper.close(); });
  if (!until(world, [&] { return world.fingers() < opened - 0.005; })) return Verdict::failed;
  act(world, stop);
  if (!comes_to_rest(world)) return Verdict::failed;
  const double rest = world.fingers();
  idle_for(world, std::chrono::milliseconds(300));
  if (world.gripper().capabilities().halts) return verdict(rest > closed + 0.005 && world.fingers() == rest);
  return verdict(fingers_at(world, closed));
}

}  // namespace

// On its way to the other end.
// [gripper-18]
Verdict a_new_goal_replaces_the_one_before(GripperWorld& world) {
  if (!starts_active(world) || !goes_to(world, opened)) return Verdict::failed;
  act(world, [](Gripper& gripper) { gripper.close(); });
  if (!until(world, [&] { return world.fingers() < opened - 0.005; })) return Verdict::failed;
  double least = world.fingers();
  act(world, [](Gripper& gripper) { gripper.open(); });
  if (!until(world, [&] {
        least = std::min(least, world.fingers());
        return rests(world);
      }))
    return Verdict::failed;
  return verdict(fingers_at(world, opened) && least > closed + 0.005 && world.gripper().trouble().is_ok());
}

// [gripper-10]
Verdict halts_or_goes_on_to_its_end(GripperWorld& world) {
  return ends_its_motion(world, [](Gripper& gripper) { gripper.halt(); });
}

// [gripper-19]
Verdict halted_it_holds_what_it_holds(GripperWorld& world) {
  if (!starts_active(world) || !goes_to(world, opened)) return Verdict::failed;
  if (!world.put_object(0.03)) return Verdict::skipped;
  if (!goes_to(world, closed)) return Verdict::failed;
  act(world, [](Gripper& gripper) { gripper.halt(); });
  idle_for(world, std::chrono::milliseconds(300));
  const bool tells = world.gripper().capabilities().detects_object;
  return verdict(rests(world) && fingers_at(world, 0.03) &&
                 (!tells || object(world) == GripperObject::gripped));
}

// [gripper-3] [exec-73]
Verdict inhibited_it_ends_its_motion_and_forgets(GripperWorld& world) {
  const Verdict ended = ends_its_motion(world, [](Gripper& gripper) { gripper.set_inhibited(true); });
  if (ended != Verdict::passed) return ended;
  const double rest = world.fingers();
  static_cast<void>(world.gripper().take_restraint());
  act(world, [](Gripper& gripper) { gripper.open(); });
  act(world, [](Gripper& gripper) { gripper.activate(); });
  if (world.gripper().take_restraint().reason != nullptr) return Verdict::failed;
  world.gripper().set_inhibited(false);
  idle_for(world, std::chrono::milliseconds(300));
  return verdict(world.fingers() == rest && goes_to(world, opened) && fingers_at(world, opened));
}

namespace {

bool is_made_safe(GripperWorld& world) {
  world.gripper().set_inhibited(true);
  for (const Time start = world.now(); world.now() - start < patience;) {
    world.receive();
    const bool safe = world.gripper().make_safe();
    world.send();
    if (safe) return true;
  }
  return false;
}

}  // namespace

// [gripper-13] [gripper-20]
Verdict made_safe_it_holds_what_it_holds(GripperWorld& world) {
  if (!starts_active(world) || !goes_to(world, opened)) return Verdict::failed;
  if (!world.put_object(0.03)) return Verdict::skipped;
  if (!goes_to(world, closed) || !is_made_safe(world)) return Verdict::failed;
  idle_for(world, std::chrono::milliseconds(300));
  if (!fingers_at(world, 0.03)) return Verdict::failed;
  world.gripper().set_inhibited(false);  // cleared, and started by a person: without an initialise()
  idle_for(world, std::chrono::milliseconds(300));
  return verdict(fingers_at(world, 0.03) && becomes_active(world) && goes_to(world, opened) &&
                 fingers_at(world, opened));
}

// [gripper-14] [gripper-20]
Verdict made_safe_it_releases_where_it_shall(GripperWorld& world) {
  if (!starts_active(world, {.safe_state = GripperSafeState::release}) || !goes_to(world, closed))
    return Verdict::failed;
  if (!is_made_safe(world) || !fingers_at(world, opened)) return Verdict::failed;
  idle_for(world, std::chrono::milliseconds(300));
  world.gripper().set_inhibited(false);
  idle_for(world, std::chrono::milliseconds(300));
  return verdict(fingers_at(world, opened) && goes_to(world, closed) && fingers_at(world, closed));
}

// Its fingers may go on, or may have lost their force: nobody knows.
// [gripper-22]
template <GripperFarEnd Behaviour>
Verdict made_safe_while_it_is_not_heard_it_confirms_nothing(GripperWorld& world) {
  if (!starts_active(world) || !goes_to(world, opened)) return Verdict::failed;
  act(world, [](Gripper& gripper) { gripper.close(); });
  if (!world.make(Behaviour)) return Verdict::skipped;
  if (!until(world, [&] { return !world.gripper().state(); })) return Verdict::failed;
  world.gripper().set_inhibited(true);
  for (int cycles = 0; cycles < 50; ++cycles) {
    world.receive();
    const bool is_heard = world.gripper().state().has_value();
    const bool safe = world.gripper().make_safe();
    world.send();
    if (safe && !is_heard) return Verdict::failed;
  }
  world.make(GripperFarEnd::well);
  if (!is_made_safe(world)) return Verdict::failed;
  const double rest = world.fingers();
  idle_for(world, std::chrono::milliseconds(300));
  return verdict(world.fingers() == rest);
}

template Verdict nonsense_is_a_fault_and_never_followed<0>(GripperWorld& world);
template Verdict nonsense_is_a_fault_and_never_followed<1>(GripperWorld& world);
template Verdict nonsense_is_a_fault_and_never_followed<2>(GripperWorld& world);
template Verdict made_safe_while_it_is_not_heard_it_confirms_nothing<GripperFarEnd::silent>(
    GripperWorld& world);
template Verdict made_safe_while_it_is_not_heard_it_confirms_nothing<GripperFarEnd::unplugged>(
    GripperWorld& world);
template Verdict made_safe_while_it_is_not_heard_it_confirms_nothing<GripperFarEnd::off>(GripperWorld& world);

}  // namespace flexrf::gripper_cases
