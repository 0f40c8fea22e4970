// The evdev drivers on input devices that uinput makes: the three conformance suites, how a device is found,
// and what the kernel had to drop.
#include <sys/stat.h>

#include <cmath>
#include <cstring>

#include "hal/operator/evdev/tests/evdev_descriptions.hpp"
#include "hal/operator/evdev/tests/evdev_suites.hpp"
#include "hal/operator/evdev/tests/evdev_world.hpp"
#include "hal/operator/joystick/evdev/evdev_joystick.hpp"
#include "hal/operator/keyboard/evdev/evdev_keyboard.hpp"
#include "hal/operator/pointer/evdev/evdev_pointer.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

constexpr int patience = 3000;
constexpr int a_while = 20;

template <class Driver, class Condition>
bool until(EvdevBench<Driver>& world, Condition is_true) {
  for (int i = 0; i < patience; ++i) {
    world.receive();
    if (is_true()) return true;
  }
  return false;
}

bool mouse_moves(EvdevBench<EvdevPointer>& mouse) {
  const std::int64_t before = mouse.driver().state().x;
  mouse.hand.report(EV_REL, REL_X, 3);
  return until(mouse, [&] { return mouse.driver().state().x == before + 3; });
}

bool mouse_is_found_by(const std::string& device) {
  UinputDescription description = pointer_description();
  description.phys = "flexrf/test/input0";
  description.product = 0xc0de;
  EvdevBench<EvdevPointer> mouse(description);
  mouse.device = device;
  const Status status = mouse.start();
  if (!status) print_message("%s\n", status.cause());
  return status.is_ok() && until(mouse, [&] { return mouse.driver().state().present; }) && mouse_moves(mouse);
}

void it_is_found_by_its_name_its_phys_and_its_numbers(void**) {
  assert_true(mouse_is_found_by("flexrf test mouse"));
  assert_true(mouse_is_found_by("flexrf/test/input0"));
  assert_true(mouse_is_found_by("1209:C0de"));
}

/// As udev makes /dev/input/by-id: a link, which after plugging in may lead elsewhere.
bool link_is_followed_anew() {
  const std::string link = "/tmp/flexrf-test-mouse";
  EvdevBench<EvdevPointer> mouse(pointer_description());
  if (symlink(mouse.hand.path().c_str(), link.c_str()) != 0) return false;
  mouse.device = link;
  bool good = mouse.start().is_ok() && until(mouse, [&] { return mouse.driver().state().present; });
  const std::string before = mouse.hand.path();
  mouse.hand.unplug();
  good = good && until(mouse, [&] { return !mouse.driver().state().present; });
  const UinputDevice other(keyboard_description());  // takes its number
  mouse.hand.plug_in();
  good = good && mouse.hand.path() != before && unlink(link.c_str()) == 0 &&
         symlink(mouse.hand.path().c_str(), link.c_str()) == 0 &&
         until(mouse, [&] { return mouse.driver().state().present; }) && mouse_moves(mouse);
  unlink(link.c_str());
  return good;
}

void a_path_is_followed_anew_when_it_is_plugged_in(void**) {
  assert_true(link_is_followed_anew());
}

bool two_of_a_name_are_refused() {
  EvdevBench<EvdevPointer> mouse(pointer_description());
  const UinputDevice twin(pointer_description());
  const Status status = mouse.start();
  print_message("%s\n", status.cause());
  return status.code() == StatusCode::invalid_argument &&
         std::strstr(status.cause(), twin.path().c_str()) != nullptr;
}

void two_that_are_meant_are_told(void**) {
  assert_true(two_of_a_name_are_refused());
}

/// A mouse with keys of its own has two devices of one name; each driver takes the one it can read.
bool the_one_that_fits_is_taken() {
  EvdevBench<EvdevPointer> mouse(pointer_description());
  UinputDescription keys = keyboard_description();
  keys.name = mouse.device;
  const UinputDevice other(keys);
  return mouse.start().is_ok() && until(mouse, [&] { return mouse.driver().state().present; }) &&
         mouse_moves(mouse);
}

void of_two_of_a_name_the_one_that_fits_is_taken(void**) {
  assert_true(the_one_that_fits_is_taken());
}

bool another_kind_is_refused() {
  EvdevBench<EvdevJoystick> joystick(pointer_description());
  const Status status = joystick.start();
  print_message("%s\n", status.cause());
  return status.code() == StatusCode::invalid_argument &&
         std::strstr(status.cause(), "no joystick") != nullptr;
}

void what_is_of_another_kind_is_told(void**) {
  assert_true(another_kind_is_refused());
}

bool nobody_else_hears_a_grabbed_one() {
  EvdevBench<EvdevPointer> mouse(pointer_description());
  EvdevBench<EvdevPointer> second(pointer_description());
  second.hand.unplug();
  second.device = mouse.hand.path();
  mouse.device = mouse.hand.path();
  mouse.grab = true;
  if (!second.start() || !mouse.start()) return false;
  if (!until(mouse, [&] { return mouse.driver().state().present; })) return false;
  if (!until(second, [&] { return second.driver().state().present; })) return false;
  if (!mouse_moves(mouse)) return false;
  for (int i = 0; i < a_while; ++i) second.receive();
  return second.driver().state().x == 0;
}

void what_is_grabbed_nobody_else_hears(void**) {
  assert_true(nobody_else_hears_a_grabbed_one());
}

/// More than the kernel keeps, while nobody reads: produced, not injected.
void flood(UinputDevice& keyboard) {
  for (int i = 0; i < 200; ++i) {
    keyboard.press(KEY_B);
    keyboard.let_go(KEY_B);
  }
}

bool holds(EvdevBench<EvdevKeyboard>& keyboard, std::initializer_list<char> letters) {
  const std::optional<HeldKeys> held = keyboard.driver().held_keys();
  if (!held || held->count != letters.size()) return false;
  for (const char letter : letters)
    if (!is_held(*held, {Key::character, static_cast<std::uint32_t>(letter)})) return false;
  return true;
}

bool what_is_down_is_known_after_an_overflow() {
  EvdevBench<EvdevKeyboard> keyboard(keyboard_description());
  if (!keyboard.start() || !until(keyboard, [&] { return keyboard.driver().held_keys()->present; }))
    return false;
  keyboard.hand.press(KEY_W);
  if (!until(keyboard, [&] { return holds(keyboard, {'w'}); })) return false;
  // Let go, and another pressed, in the midst of what is dropped.
  flood(keyboard.hand);
  keyboard.hand.let_go(KEY_W);
  keyboard.hand.press(KEY_D);
  flood(keyboard.hand);
  if (!until(keyboard, [&] { return holds(keyboard, {'d'}); })) return false;
  keyboard.hand.let_go(KEY_D);
  return until(keyboard, [&] { return holds(keyboard, {}); });
}

void after_an_overflow_what_is_down_is_known(void**) {
  assert_true(what_is_down_is_known_after_an_overflow());
}

bool deflection_is_known_after_an_overflow() {
  EvdevBench<EvdevJoystick> joystick(joystick_description());
  if (!joystick.start() || !until(joystick, [&] { return joystick.driver().state().present; })) return false;
  for (int i = 0; i < 300; ++i) joystick.hand.report(EV_ABS, ABS_X, i % 256);
  joystick.hand.press(BTN_TRIGGER);
  joystick.hand.report(EV_ABS, ABS_X, 255);
  for (int i = 0; i < 300; ++i) joystick.hand.report(EV_ABS, ABS_Y, 100 * (i + 1));
  joystick.hand.report(EV_ABS, ABS_Y, -32768);
  const auto now = [&]() -> const JoystickState& { return joystick.driver().state(); };
  return until(joystick, [&] { return now().axes[0] == 1 && now().axes[1] == -1 && now().buttons == 1; }) &&
         joystick.bench().feedback().overflows > 0 && joystick.bench().feedback().losses == 0;
}

void after_an_overflow_the_deflection_is_known(void**) {
  assert_true(deflection_is_known_after_an_overflow());
}

bool shift_and_repetition_are_understood() {
  EvdevBench<EvdevKeyboard> keyboard(keyboard_description());
  if (!keyboard.start() || !until(keyboard, [&] { return keyboard.driver().held_keys()->present; }))
    return false;
  keyboard.hand.press(KEY_LEFTSHIFT);
  keyboard.hand.press(KEY_W);
  keyboard.hand.report(EV_KEY, KEY_W, 2);
  keyboard.hand.report(EV_KEY, KEY_W, 2);
  keyboard.hand.let_go(KEY_LEFTSHIFT);
  if (!until(keyboard, [&] { return holds(keyboard, {'w'}); })) return false;
  for (int i = 0; i < a_while; ++i) keyboard.receive();
  const auto first = keyboard.driver().read();
  return first && first->character == 'W' && !keyboard.driver().read();
}

void a_held_key_is_pressed_once_and_shift_counts(void**) {
  assert_true(shift_and_repetition_are_understood());
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(it_is_found_by_its_name_its_phys_and_its_numbers),
      cmocka_unit_test(a_path_is_followed_anew_when_it_is_plugged_in),
      cmocka_unit_test(two_that_are_meant_are_told),
      cmocka_unit_test(of_two_of_a_name_the_one_that_fits_is_taken),
      cmocka_unit_test(what_is_of_another_kind_is_told),
      cmocka_unit_test(what_is_grabbed_nobody_else_hears),
      cmocka_unit_test(after_an_overflow_what_is_down_is_known),
      cmocka_unit_test(after_an_overflow_the_deflection_is_known),
      cmocka_unit_test(a_held_key_is_pressed_once_and_shift_counts),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr) + run_evdev_keyboard_suite() +
         run_evdev_pointer_suite() + run_evdev_joystick_suite();
}
