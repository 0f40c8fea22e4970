#include "units/hand_jog/hand_jog.hpp"

#include <cmath>

#include "hal/operator/joystick/interface/joystick_tracker.hpp"
#include "hal/operator/keyboard/interface/key_tracker.hpp"
#include "hal/operator/pointer/interface/pointer_tracker.hpp"
#include "tests/cmocka.hpp"
#include "units/unit_bench.hpp"

namespace {

using namespace flexrf;
using namespace flexrf::user;

constexpr Duration cycle = std::chrono::milliseconds(10);
constexpr std::size_t dead_man = 0;
constexpr KeyEvent space{Key::character, ' '};
constexpr double full = 0.1;  // m/s

constexpr KeyEvent letter(char character) {
  return {Key::character, static_cast<std::uint32_t>(character)};
}

struct World {
  UnitBench<HandJog> bench;
  KeyTracker keyboard;
  PointerTracker pointer;
  JoystickTracker joystick;
  bool heard = true;  // devices publish in every cycle
  SlotBench<HeldKeys> keys;
  SlotBench<PointerState> motion;
  SlotBench<JoystickState> stick;
  SlotBench<Velocity> velocity;
  InputBinding inputs[3] = {keys.input(std::chrono::milliseconds(100)),
                            motion.input(std::chrono::milliseconds(100)),
                            stick.input(std::chrono::milliseconds(100))};
  SlotControl* outputs[1] = {&velocity.control()};

  World() {
    UnitBinding binding;
    binding.context = &bench.context();
    binding.inputs = inputs;
    binding.outputs = outputs;
    bench.unit().connect(binding);
    bench.runtime().speed = full;
    keyboard.appear();
    pointer.appear();
    joystick.appear();
    if (bench.unit().initialise()) step();
  }
  void step() {
    if (heard) {
      keys.publish(keyboard.held(), bench.now());
      motion.publish(pointer.state(), bench.now());
      stick.publish(joystick.state(), bench.now());
    }
    bench.step(cycle);
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) step();
  }
  bool moves(double x, double y, double z, double tolerance = 1e-12) {
    const auto now = velocity.latest();
    return now && std::abs(now->linear[0] - x) < tolerance && std::abs(now->linear[1] - y) < tolerance &&
           std::abs(now->linear[2] - z) < tolerance;
  }
  bool rests() { return moves(0, 0, 0); }
  bool is_moved_by(HandSource source) { return bench.feedback().source == source; }
  bool says_why() { return bench.feedback().holding[0] != '\0'; }
  /// How far the tool gets in so many cycles.
  std::array<double, 3> path(int cycles) {
    std::array<double, 3> way{};
    for (int i = 0; i < cycles; ++i) {
      step();
      const auto now = velocity.latest();
      for (std::size_t axis = 0; axis < 3; ++axis) way[axis] += now->linear[axis] * seconds(cycle);
    }
    return way;
  }
};

bool keys_move_while_the_dead_man_is_held() {
  World world;
  world.keyboard.press(letter('w'));
  world.step();
  if (!world.rests()) return false;  // without it
  world.keyboard.let_go(letter('w'));
  world.step();
  world.keyboard.press(space);
  world.step();
  if (!world.rests() || !world.is_moved_by(HandSource::keyboard)) return false;
  world.keyboard.press(letter('w'));
  world.step();
  if (!world.moves(full, 0, 0)) return false;
  world.keyboard.press(letter('d'));
  world.step();
  if (!world.moves(full * std::sqrt(0.5), -full * std::sqrt(0.5), 0)) return false;
  world.keyboard.let_go(space);
  world.step();
  return world.rests() && world.is_moved_by(HandSource::none) && !world.says_why();
}

bool a_dead_man_that_was_down_before_does_not_count() {
  World world;
  world.keyboard.press(letter('w'));
  world.step();
  world.keyboard.press(space);  // motion was asked for before it
  world.steps(3);
  if (!world.rests() || !world.says_why()) return false;
  world.keyboard.let_go(space);
  world.step();  // 'w' is still down
  world.keyboard.press(space);
  world.steps(3);
  if (!world.rests()) return false;
  world.keyboard.let_go(space);
  world.keyboard.let_go(letter('w'));
  world.step();
  world.keyboard.press(space);
  world.keyboard.press(letter('w'));
  world.step();
  return world.moves(full, 0, 0) && !world.says_why();
}

bool unplugged_in_mid_press_it_stops_and_stays() {
  World world;
  world.joystick.press(dead_man);
  world.joystick.deflect(1, -1);
  world.step();
  if (!world.moves(full, 0, 0)) return false;
  world.joystick.vanish();
  world.step();
  if (!world.rests()) return false;
  // Back, and its hand holds both still.
  world.joystick.appear();
  world.joystick.press(dead_man);
  world.joystick.deflect(1, -1);
  world.steps(5);
  if (!world.rests() || !world.says_why()) return false;
  world.joystick.let_go(dead_man);
  world.joystick.deflect(1, 0);
  world.step();
  world.joystick.press(dead_man);
  world.joystick.deflect(1, -0.5);
  world.step();
  return world.moves(full / 2, 0, 0);
}

bool what_is_not_heard_of_has_let_go() {
  World world;
  world.joystick.press(dead_man);
  world.joystick.deflect(0, 1);
  world.step();
  if (!world.moves(0, -full, 0)) return false;
  world.heard = false;
  world.steps(12);
  if (!world.rests()) return false;
  world.heard = true;
  world.steps(2);
  return world.rests();
}

bool inhibited_or_stopping_it_rests() {
  World world;
  world.keyboard.press(space);
  world.step();
  world.keyboard.press(letter('q'));
  world.step();
  if (!world.moves(0, 0, full)) return false;
  world.bench.tick().motion_inhibited = true;
  world.step();
  if (!world.rests() || !world.says_why()) return false;
  world.bench.tick().motion_inhibited = false;
  world.steps(3);
  if (!world.rests()) return false;  // permitted again, nothing moves by itself
  world.keyboard.vanish();
  world.step();
  world.keyboard.appear();
  world.step();
  world.keyboard.press(space);
  world.step();
  world.keyboard.press(letter('e'));
  world.step();
  if (!world.moves(0, 0, -full)) return false;
  world.bench.tick().stop_requested = true;
  world.step();
  return world.rests();
}

bool a_mouse_moves_by_distance() {
  World world;
  world.bench.runtime().count = 0.00005;
  world.pointer.move(500, 500);  // without the button
  world.step();
  world.pointer.press(dead_man);
  world.step();
  if (!world.rests() || !world.is_moved_by(HandSource::pointer)) return false;
  world.pointer.move(-20, -100);
  const auto way = world.path(150);
  if (std::abs(way[0] - 0.005) > 1e-5 || std::abs(way[1] - 0.001) > 1e-5 || !world.rests()) return false;
  world.pointer.turn(120, 0);
  const auto up = world.path(150);
  return std::abs(up[2] - world.bench.runtime().detent) < 1e-5 && std::abs(up[0]) < 1e-5;
}

bool a_mouse_is_no_faster_than_its_limit_and_nothing_runs_on() {
  World world;
  world.pointer.press(dead_man);
  world.step();
  world.pointer.move(0, -1'000'000);  // torn away
  world.step();
  if (!world.moves(full, 0, 0, 1e-9)) return false;
  const auto way = world.path(150);
  if (way[0] > full * 0.1 || !world.rests()) return false;
  world.pointer.move(0, -1'000'000);
  world.step();
  world.pointer.let_go(dead_man);
  world.step();
  if (!world.rests()) return false;
  // What was left then is not made up for now.
  world.pointer.press(dead_man);
  world.steps(2);
  return world.rests() && world.is_moved_by(HandSource::pointer);
}

bool who_has_it_keeps_it() {
  World world;
  world.joystick.press(dead_man);
  world.step();
  world.joystick.deflect(1, -1);
  world.keyboard.press(space);
  world.step();
  world.keyboard.press(letter('s'));
  world.step();
  if (!world.moves(full, 0, 0) || !world.is_moved_by(HandSource::joystick)) return false;
  world.joystick.let_go(dead_man);
  world.step();
  return world.moves(-full, 0, 0) && world.is_moved_by(HandSource::keyboard);
}

bool axes_and_buttons_are_as_configured() {
  World world;
  auto& configuration =
      *static_cast<HandJog::Configuration*>(world.bench.unit().parameter_memory().configuration);
  configuration.joystick_dead_man = 5;
  configuration.joystick_axes = {2, 3, 0};
  configuration.joystick_signs = {1, 0, -1};
  world.joystick.press(5);
  world.step();
  world.joystick.deflect(2, 0.6);
  world.joystick.deflect(3, 1);
  world.joystick.deflect(0, 0.8);
  world.joystick.deflect(1, 1);
  world.step();
  return world.moves(0.6 * full, 0, -0.8 * full, 1e-9);
}

template <bool (*Case)()>
void holds_true(void**) {
  assert_true(Case());
}

}  // namespace

int main() {
#define CASE(name) \
  { #name, holds_true < name>, nullptr, nullptr, nullptr }
  const CMUnitTest tests[] = {
      CASE(keys_move_while_the_dead_man_is_held),
      CASE(a_dead_man_that_was_down_before_does_not_count),
      CASE(unplugged_in_mid_press_it_stops_and_stays),
      CASE(what_is_not_heard_of_has_let_go),
      CASE(inhibited_or_stopping_it_rests),
      CASE(a_mouse_moves_by_distance),
      CASE(a_mouse_is_no_faster_than_its_limit_and_nothing_runs_on),
      CASE(who_has_it_keeps_it),
      CASE(axes_and_buttons_are_as_configured),
  };
#undef CASE
  return cmocka_run_group_tests_name("hand jog", tests, nullptr, nullptr);
}
