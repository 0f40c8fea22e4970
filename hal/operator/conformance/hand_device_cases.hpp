// The cases that the drivers of Pointer and of Joystick have in common. To be included behind what they test:
// CMocka's macros spare no names.
#pragma once

#include "tests/conformance.hpp"

namespace flexrf::hand_device {

/// Cycles after which what must happen has happened. Only the real kernel takes more than one.
inline constexpr int patience = 3000;
/// Cycles after which what must not happen would have.
inline constexpr int a_while = 5;

/// `is_true`: of the device's state.
template <class World, class Condition>
bool until(World& world, Condition is_true) {
  for (int i = 0; i < patience; ++i) {
    world.receive();
    if (is_true(world.device().state())) return true;
  }
  return false;
}

template <class World, class Condition>
bool stays(World& world, Condition is_true) {
  for (int i = 0; i < a_while; ++i) {
    world.receive();
    if (!is_true(world.device().state())) return false;
  }
  return true;
}

inline constexpr auto is_there = [](const auto& state) { return state.present; };
inline constexpr auto is_away = [](const auto& state) { return !state.present; };

// [joystick-2] [pointer-1]
template <class World>
Verdict a_press_shorter_than_a_cycle_counts(World& world) {
  if (!world.start() || !until(world, is_there)) return Verdict::failed;
  for (int i = 0; i < 2; ++i) {
    world.press(2);
    world.let_go(2);
  }
  return verdict(until(world, [](const auto& state) { return state.presses[2] == 2 && state.buttons == 0; }));
}

template <class World>
Verdict it_comes_back_as_often_as_it_goes(World& world) {
  if (!world.start()) return Verdict::failed;
  for (int i = 0; i < 3; ++i) {
    if (!until(world, is_there)) return Verdict::failed;
    world.unplug();
    if (!until(world, is_away)) return Verdict::failed;
    world.plug_in();
  }
  return verdict(until(world, is_there) && world.feedback().losses == 3);
}

template <class World>
Verdict refused(World& world, StatusCode code) {
  const Status status = world.start();
  print_message("%s\n", status.cause());
  return verdict(status.code() == code && status.cause()[0] != '\0');
}

template <class World>
Verdict one_that_is_not_there_is_told(World& world) {
  return world.hide() ? refused(world, StatusCode::not_found) : Verdict::skipped;
}
template <class World>
Verdict a_missing_right_is_told(World& world) {
  return world.forbid() ? refused(world, StatusCode::not_permitted) : Verdict::skipped;
}
template <class World>
Verdict one_that_somebody_else_has_is_told(World& world) {
  return world.occupy() ? refused(world, StatusCode::busy) : Verdict::skipped;
}

}  // namespace flexrf::hand_device
