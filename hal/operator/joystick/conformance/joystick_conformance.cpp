#include "hal/operator/joystick/conformance/joystick_conformance.hpp"

#include <algorithm>
#include <cmath>

#include "hal/operator/conformance/hand_device_cases.hpp"

namespace flexrf {
namespace {

using namespace hand_device;

MakeJoystickWorld make_world = nullptr;

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

// [joystick-1]
Verdict an_axis_goes_from_end_to_end(JoystickWorld& world) {
  if (!world.start() || !until(world, is_there)) return Verdict::failed;
  for (const std::size_t axis : {0U, 1U, 3U}) {
    for (const double part : {1.0, -1.0, 0.6, -0.6}) {
      world.deflect(axis, part);
      const double dead = std::copysign(JoystickWorld::dead_zone, part);
      if (!becomes(world, axis, (part - dead) / (1 - JoystickWorld::dead_zone))) return Verdict::failed;
    }
    const JoystickState& state = world.device().state();
    const std::size_t other = axis == 0 ? 1 : 0;
    if (state.axes[other] != 0) return Verdict::failed;
    world.deflect(axis, 0);
    if (!until(world, at_rest)) return Verdict::failed;
  }
  return Verdict::passed;
}

// [joystick-tracker-3]
Verdict the_dead_zone_is_rest(JoystickWorld& world) {
  if (!world.start() || !until(world, is_there)) return Verdict::failed;
  for (const double part : {0.18, -0.18}) {
    world.deflect(0, part);
    world.press(0);  // after which the axis has been heard of, too
    if (!until(world, [](const JoystickState& state) { return state.buttons == 1; })) return Verdict::failed;
    if (world.device().state().axes[0] != 0) return Verdict::failed;
    world.let_go(0);
    if (!until(world, at_rest)) return Verdict::failed;
  }
  return Verdict::passed;
}

// [joystick-1]
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

// [joystick-2] [joystick-tracker-5]
Verdict it_is_at_rest_once_it_is_unplugged(JoystickWorld& world) {
  if (!world.start() || !until(world, is_there)) return Verdict::failed;
  world.deflect(1, -1);
  world.press(0);
  if (!until(world, [](const JoystickState& state) { return state.buttons == 1 && state.axes[1] == -1; }))
    return Verdict::failed;
  world.unplug();
  if (!until(world, is_away) || !at_rest(world.device().state()) || world.feedback().present ||
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
                 world.device().fault().is_ok());
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
