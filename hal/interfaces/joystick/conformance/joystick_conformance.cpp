#include "hal/interfaces/joystick/conformance/joystick_conformance.hpp"

#include <algorithm>
#include <cmath>

#include "tests/conformance.hpp"

namespace flexrf {
namespace {

/// Cycles after which what must happen has happened. Only the real kernel takes more than one.
constexpr int patience = 3000;
/// Cycles after which what must not happen would have.
constexpr int a_while = 5;

MakeJoystickWorld make_world = nullptr;

template <class Condition>
bool until(JoystickWorld& world, Condition is_true) {
  for (int i = 0; i < patience; ++i) {
    world.receive();
    if (is_true(world.joystick().state())) return true;
  }
  return false;
}

template <class Condition>
bool stays(JoystickWorld& world, Condition is_true) {
  for (int i = 0; i < a_while; ++i) {
    world.receive();
    if (!is_true(world.joystick().state())) return false;
  }
  return true;
}

bool is_there(const JoystickState& state) {
  return state.present;
}
bool is_away(const JoystickState& state) {
  return !state.present;
}
bool at_rest(const JoystickState& state) {
  return state.buttons == 0 &&
         std::all_of(state.axes.begin(), state.axes.end(), [](double axis) { return axis == 0; });
}

bool becomes(JoystickWorld& world, std::size_t axis, double value) {
  return until(world, [=](const JoystickState& state) {
    return std::abs(state.axes[axis] - value) <= JoystickWorld::resolution;
  });
}

Verdict it_is_at_rest_at_first(JoystickWorld& world) {
  if (!world.start() || !until(world, is_there)) return Verdict::failed;
  return verdict(stays(world, at_rest));
}

Verdict an_axis_goes_from_end_to_end(JoystickWorld& world) {
  if (!world.start() || !until(world, is_there)) return Verdict::failed;
  for (const std::size_t axis : {0U, 1U, 3U}) {
    for (const double part : {1.0, -1.0, 0.6, -0.6}) {
      world.deflect(axis, part);
      const double dead = std::copysign(JoystickWorld::dead_zone, part);
      if (!becomes(world, axis, (part - dead) / (1 - JoystickWorld::dead_zone))) return Verdict::failed;
    }
    const JoystickState& state = world.joystick().state();
    const std::size_t other = axis == 0 ? 1 : 0;
    if (state.axes[other] != 0) return Verdict::failed;
    world.deflect(axis, 0);
    if (!until(world, at_rest)) return Verdict::failed;
  }
  return Verdict::passed;
}

Verdict the_dead_zone_is_rest(JoystickWorld& world) {
  if (!world.start() || !until(world, is_there)) return Verdict::failed;
  for (const double part : {0.18, -0.18}) {
    world.deflect(0, part);
    world.press(0);  // after which the axis has been heard of, too
    if (!until(world, [](const JoystickState& state) { return state.buttons == 1; })) return Verdict::failed;
    if (world.joystick().state().axes[0] != 0) return Verdict::failed;
    world.let_go(0);
    if (!until(world, at_rest)) return Verdict::failed;
  }
  return Verdict::passed;
}

Verdict a_button_is_down_until_it_is_let_go(JoystickWorld& world) {
  if (!world.start() || !until(world, is_there)) return Verdict::failed;
  world.press(1);
  const auto second = [](const JoystickState& state) { return state.buttons == 2 && state.presses[1] == 1; };
  if (!until(world, second) || !stays(world, second)) return Verdict::failed;
  world.press(3);
  if (!until(world, [](const JoystickState& state) { return state.buttons == 10; })) return Verdict::failed;
  world.let_go(1);
  world.let_go(3);
  return verdict(until(world, at_rest));
}

Verdict a_press_shorter_than_a_cycle_counts(JoystickWorld& world) {
  if (!world.start() || !until(world, is_there)) return Verdict::failed;
  for (int i = 0; i < 2; ++i) {
    world.press(2);
    world.let_go(2);
  }
  return verdict(
      until(world, [](const JoystickState& state) { return state.presses[2] == 2 && state.buttons == 0; }));
}

Verdict it_is_at_rest_once_it_is_unplugged(JoystickWorld& world) {
  if (!world.start() || !until(world, is_there)) return Verdict::failed;
  world.deflect(1, -1);
  world.press(0);
  if (!until(world, [](const JoystickState& state) { return state.buttons == 1 && state.axes[1] == -1; }))
    return Verdict::failed;
  world.unplug();
  if (!until(world, is_away) || !at_rest(world.joystick().state()) || world.feedback().present ||
      world.feedback().losses != 1)
    return Verdict::failed;
  world.plug_in();
  if (!until(world, is_there) || !world.feedback().present || !stays(world, at_rest)) return Verdict::failed;
  world.deflect(1, 1);
  world.press(0);
  return verdict(until(world,
                       [](const JoystickState& state) {
                         return state.buttons == 1 && state.presses[0] == 2 && state.axes[1] == 1;
                       }) &&
                 world.joystick().fault().is_ok());
}

Verdict it_comes_back_as_often_as_it_goes(JoystickWorld& world) {
  if (!world.start()) return Verdict::failed;
  for (int i = 0; i < 3; ++i) {
    if (!until(world, is_there)) return Verdict::failed;
    world.unplug();
    if (!until(world, is_away)) return Verdict::failed;
    world.plug_in();
  }
  return verdict(until(world, is_there) && world.feedback().losses == 3);
}

Verdict refused(JoystickWorld& world, StatusCode code) {
  const Status status = world.start();
  print_message("%s\n", status.cause());
  return verdict(status.code() == code && status.cause()[0] != '\0');
}

Verdict one_that_is_not_there_is_told(JoystickWorld& world) {
  return world.hide() ? refused(world, StatusCode::not_found) : Verdict::skipped;
}
Verdict a_missing_right_is_told(JoystickWorld& world) {
  return world.forbid() ? refused(world, StatusCode::not_permitted) : Verdict::skipped;
}
Verdict one_that_somebody_else_has_is_told(JoystickWorld& world) {
  return world.occupy() ? refused(world, StatusCode::busy) : Verdict::skipped;
}

template <Verdict (*Run)(JoystickWorld&)>
void judged(void**) {
  judge(make_world, Run);
}

}  // namespace

int run_joystick_conformance(const char* driver, MakeJoystickWorld make) {
  make_world = make;
#define CASE(name) \
  { #name, judged < name>, nullptr, nullptr, nullptr }
  const CMUnitTest tests[] = {
      CASE(it_is_at_rest_at_first),
      CASE(an_axis_goes_from_end_to_end),
      CASE(the_dead_zone_is_rest),
      CASE(a_button_is_down_until_it_is_let_go),
      CASE(a_press_shorter_than_a_cycle_counts),
      CASE(it_is_at_rest_once_it_is_unplugged),
      CASE(it_comes_back_as_often_as_it_goes),
      CASE(one_that_is_not_there_is_told),
      CASE(a_missing_right_is_told),
      CASE(one_that_somebody_else_has_is_told),
  };
#undef CASE
  return cmocka_run_group_tests_name(driver, tests, nullptr, nullptr);
}

}  // namespace flexrf
