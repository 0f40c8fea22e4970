#include "hal/operator/pointer/conformance/pointer_conformance.hpp"

#include "hal/operator/conformance/hand_device_cases.hpp"

namespace flexrf {
namespace {

using namespace hand_device;

MakePointerWorld make_world = nullptr;

Verdict nothing_is_moved_nothing_is_told(PointerWorld& world) {
  if (!world.start() || !until(world, is_there)) return Verdict::failed;
  return verdict(stays(world, [](const PointerState& state) {
    return state.x == 0 && state.y == 0 && state.wheel == 0 && state.tilt == 0 && state.buttons == 0 &&
           state.presses[0] == 0;
  }));
}

// [pointer-1]
Verdict motion_adds_up(PointerWorld& world) {
  if (!world.start() || !until(world, is_there)) return Verdict::failed;
  for (int i = 0; i < 10; ++i) {
    world.move(7, -3);
    world.receive();
  }
  world.move(-20, 40);
  const auto arrived = [](const PointerState& state) { return state.x == 50 && state.y == 10; };
  return verdict(until(world, arrived) && stays(world, arrived));
}

Verdict the_wheel_turns_by_detents(PointerWorld& world) {
  if (!world.start() || !until(world, is_there)) return Verdict::failed;
  world.turn_wheel(2);
  if (!until(world, [](const PointerState& state) { return state.wheel == 240; })) return Verdict::failed;
  world.turn_wheel(-3);
  return verdict(until(world, [](const PointerState& state) { return state.wheel == -120; }));
}

// [pointer-1]
Verdict a_button_is_down_until_it_is_let_go(PointerWorld& world) {
  if (!world.start() || !until(world, is_there)) return Verdict::failed;
  world.press(0);
  const auto left = [](const PointerState& state) { return state.buttons == 1 && state.presses[0] == 1; };
  if (!until(world, left) || !stays(world, left)) return Verdict::failed;
  world.press(2);
  if (!until(world, [](const PointerState& state) { return state.buttons == 5; })) return Verdict::failed;
  world.let_go(0);
  if (!until(world, [](const PointerState& state) { return state.buttons == 4; })) return Verdict::failed;
  world.let_go(2);
  return verdict(until(world, [](const PointerState& state) { return state.buttons == 0; }));
}

// [pointer-2] [pointer-tracker-1]
Verdict a_button_is_not_down_once_it_is_unplugged(PointerWorld& world) {
  if (!world.start() || !until(world, is_there)) return Verdict::failed;
  world.move(5, 5);
  world.press(0);
  if (!until(world, [](const PointerState& state) { return state.buttons == 1 && state.x == 5; }))
    return Verdict::failed;
  world.unplug();
  if (!until(world, is_away) || world.device().state().buttons != 0 || world.feedback().present ||
      world.feedback().losses != 1)
    return Verdict::failed;
  world.plug_in();
  if (!until(world, is_there) || !world.feedback().present) return Verdict::failed;
  const auto at_rest = [](const PointerState& state) { return state.buttons == 0 && state.x == 5; };
  if (!stays(world, at_rest)) return Verdict::failed;
  world.move(1, 0);
  world.press(0);
  return verdict(until(world,
                       [](const PointerState& state) {
                         return state.buttons == 1 && state.presses[0] == 2 && state.x == 6;
                       }) &&
                 world.device().fault().is_ok());
}

template <Verdict (*Run)(PointerWorld&)>
void judged(void**) {
  judge(make_world, Run);
}

}  // namespace

int run_pointer_conformance(const char* driver, MakePointerWorld make) {
  make_world = make;
#define CASE(name) \
  { #name, judged < name>, nullptr, nullptr, nullptr }
  const CMUnitTest tests[] = {
      CASE(nothing_is_moved_nothing_is_told),
      CASE(motion_adds_up),
      CASE(the_wheel_turns_by_detents),
      CASE(a_button_is_down_until_it_is_let_go),
      CASE(a_press_shorter_than_a_cycle_counts),
      CASE(a_button_is_not_down_once_it_is_unplugged),
      CASE(it_comes_back_as_often_as_it_goes),
      CASE(one_that_is_not_there_is_told),
      CASE(a_missing_right_is_told),
      CASE(one_that_somebody_else_has_is_told),
  };
#undef CASE
  return cmocka_run_group_tests_name(driver, tests, nullptr, nullptr);
}

}  // namespace flexrf
