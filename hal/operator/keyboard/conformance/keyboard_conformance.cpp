#include "hal/operator/keyboard/conformance/keyboard_conformance.hpp"

#include <poll.h>

#include <algorithm>

#include "hal/operator/keyboard/interface/key_tracker.hpp"
#include "tests/conformance.hpp"

namespace flexrf {
namespace {

// Cycles after which what was pressed must have arrived; drivers that wait on a clock are given its time by
// their worlds.
constexpr int patience = 100;
/// Cycles after which a keyboard that is plugged in again is known.
constexpr int long_patience = 3000;

MakeKeyboardWorld make_world = nullptr;

std::vector<KeyEvent> letters(std::size_t count) {
  std::vector<KeyEvent> events;
  for (std::size_t i = 0; i < count; ++i)
    events.push_back({Key::character, static_cast<std::uint32_t>('a' + i % 26)});
  return events;
}

bool equal(const std::vector<KeyEvent>& a, const std::vector<KeyEvent>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), is_same_key);
}

// Reads until `count` keys came or patience ends.
std::vector<KeyEvent> read(KeyboardWorld& world, std::size_t count) {
  std::vector<KeyEvent> events;
  for (int cycle = 0; cycle < patience && events.size() < count; ++cycle) {
    world.receive();
    while (const auto event = world.keyboard().read()) events.push_back(*event);
  }
  return events;
}

Verdict nothing_is_pressed_nothing_is_read(KeyboardWorld& world) {
  world.will_press({}, false);
  if (!world.start({})) return Verdict::failed;
  return verdict(read(world, 1).empty());
}

// [keyboard-2]
Verdict each_press_is_read_once_in_order(KeyboardWorld& world) {
  const std::vector<KeyEvent> pressed = letters(40);
  world.will_press(pressed, false);
  if (!world.start({})) return Verdict::failed;
  const std::vector<KeyEvent> got = read(world, pressed.size());
  return verdict(equal(got, pressed) && read(world, 1).empty());
}

Verdict arrows_are_keys(KeyboardWorld& world) {
  if (!world.has_arrows()) return Verdict::skipped;
  const std::vector<KeyEvent> pressed = {{Key::up, 0}, {Key::down, 0}, {Key::left, 0}, {Key::right, 0}};
  world.will_press(pressed, true);
  if (!world.start({})) return Verdict::failed;
  return verdict(equal(read(world, pressed.size()), pressed));
}

// [keyboard-1]
Verdict closes_after_its_last_key(KeyboardWorld& world) {
  if (!world.can_end()) return Verdict::skipped;
  const std::vector<KeyEvent> pressed = letters(3);
  world.will_press(pressed, true);
  if (!world.start({})) return Verdict::failed;
  std::size_t got = 0;
  for (int cycle = 0; cycle < patience && !world.keyboard().is_closed(); ++cycle) {
    world.receive();
    if (world.keyboard().read()) ++got;
  }
  return verdict(got == pressed.size() && world.keyboard().is_closed() && !world.keyboard().read());
}

// [keyboard-1]
Verdict stays_open_while_keys_may_come(KeyboardWorld& world) {
  world.will_press(letters(3), true);
  if (!world.start({})) return Verdict::failed;
  for (int got = 0, cycle = 0; got < 2 && cycle < patience; ++cycle) {
    world.receive();
    if (got < 2 && world.keyboard().read()) ++got;
  }
  return verdict(!world.keyboard().is_closed());
}

// The reader takes one key in a cycle: the queue is full nearly always, and none may be lost.
// [keyboard-1] [keyboard-4]
Verdict a_full_queue_loses_nothing(KeyboardWorld& world) {
  const std::vector<KeyEvent> pressed = letters(40);
  world.will_press(pressed, true);
  QueueBench<KeyEvent, 4> queue;
  if (!world.start(queue.sinks())) return Verdict::failed;
  std::vector<KeyEvent> got;
  for (int cycle = 0; cycle < patience && got.size() < pressed.size(); ++cycle) {
    world.receive();
    if (got.size() + 4 < pressed.size() && world.keyboard().is_closed()) return Verdict::failed;
    if (const auto event = queue.pop()) got.push_back(*event);
  }
  world.receive();
  return verdict(equal(got, pressed) && queue.ring().counters().dropped == 0 &&
                 world.keyboard().is_closed() == world.can_end());
}

/// By its descriptor, or by the time that it names.
bool asks_to_be_called_again(const Keyboard& keyboard) {
  if (keyboard.next_event() != Time::max()) return true;
  pollfd watched{keyboard.descriptor(), POLLIN, 0};
  constexpr int longest_wait = 1000;  // ms
  return watched.fd >= 0 && poll(&watched, 1, longest_wait) == 1;
}

// The reader comes when every press is with the driver, and nothing else is pressed.
// [keyboard-5]
Verdict what_has_no_room_asks_again(KeyboardWorld& world) {
  world.will_press(letters(12), false);
  QueueBench<KeyEvent, 4> queue;
  if (!world.start(queue.sinks())) return Verdict::failed;
  for (int cycle = 0; cycle < patience; ++cycle) world.receive();
  if (queue.ring().fill() != 4) return Verdict::failed;
  while (queue.pop()) continue;
  return verdict(asks_to_be_called_again(world.keyboard()));
}

/// What is down becomes these keys.
bool held_become(KeyboardWorld& world, const std::vector<KeyEvent>& keys) {
  for (int cycle = 0; cycle < long_patience; ++cycle) {
    world.receive();
    const std::optional<HeldKeys> held = world.keyboard().held_keys();
    if (held && held->present && held->count == keys.size() &&
        std::equal(keys.begin(), keys.end(), held->keys.begin(), is_same_key))
      return true;
  }
  return false;
}

bool goes_away(KeyboardWorld& world) {
  for (int cycle = 0; cycle < long_patience; ++cycle) {
    world.receive();
    const std::optional<HeldKeys> held = world.keyboard().held_keys();
    if (held && !held->present) return held->count == 0;
  }
  return false;
}

constexpr KeyEvent letter_w{Key::character, 'w'};
constexpr KeyEvent letter_d{Key::character, 'd'};
constexpr KeyEvent arrow{Key::up, 0};

// [keyboard-3]
Verdict a_key_is_held_until_it_is_let_go(KeyboardWorld& world) {
  world.will_press({}, false);
  if (!world.start({})) return Verdict::failed;
  if (!world.hold(letter_w)) return verdict(!world.keyboard().held_keys());
  if (!held_become(world, {letter_w})) return Verdict::failed;
  world.hold(arrow);
  world.hold(letter_d);
  if (!held_become(world, {letter_w, arrow, letter_d})) return Verdict::failed;
  world.let_go(letter_w);
  if (!held_become(world, {arrow, letter_d})) return Verdict::failed;
  world.let_go(letter_d);
  world.let_go(arrow);
  if (!held_become(world, {})) return Verdict::failed;
  // Held for as long as it may be, a key was pressed once.
  return verdict(equal(read(world, 4), {letter_w, arrow, letter_d}));
}

// [key-tracker-1]
Verdict no_key_is_held_once_it_is_unplugged(KeyboardWorld& world) {
  world.will_press({}, false);
  if (!world.start({})) return Verdict::failed;
  if (!world.hold(letter_w)) return Verdict::skipped;
  if (!held_become(world, {letter_w})) return Verdict::failed;
  if (!world.unplug() || !goes_away(world)) return Verdict::failed;
  if (!world.plug_in() || !held_become(world, {})) return Verdict::failed;
  if (!equal(read(world, 2), {letter_w})) return Verdict::failed;  // that of before, and none by plugging in
  world.hold(letter_d);
  return verdict(held_become(world, {letter_d}) && equal(read(world, 1), {letter_d}) &&
                 world.keyboard().fault().is_ok());
}

Verdict refused(KeyboardWorld& world, StatusCode code) {
  const Status status = world.start({});
  print_message("%s\n", status.cause());
  return verdict(status.code() == code && status.cause()[0] != '\0');
}

Verdict one_that_is_not_there_is_told(KeyboardWorld& world) {
  return world.hide() ? refused(world, StatusCode::not_found) : Verdict::skipped;
}
Verdict a_missing_right_is_told(KeyboardWorld& world) {
  return world.forbid() ? refused(world, StatusCode::not_permitted) : Verdict::skipped;
}
Verdict one_that_somebody_else_has_is_told(KeyboardWorld& world) {
  return world.occupy() ? refused(world, StatusCode::busy) : Verdict::skipped;
}

template <Verdict (*Run)(KeyboardWorld&)>
void judged(void**) {
  judge(make_world, Run);
}

}  // namespace

int run_keyboard_conformance(const char* driver, MakeKeyboardWorld make) {
  make_world = make;
  const CMUnitTest tests[] = {
      {"nothing is pressed, nothing is read", judged<nothing_is_pressed_nothing_is_read>, nullptr, nullptr,
       nullptr},
      {"each press is read once, in order", judged<each_press_is_read_once_in_order>, nullptr, nullptr,
       nullptr},
      {"arrows are keys", judged<arrows_are_keys>, nullptr, nullptr, nullptr},
      {"closes after its last key", judged<closes_after_its_last_key>, nullptr, nullptr, nullptr},
      {"stays open while keys may come", judged<stays_open_while_keys_may_come>, nullptr, nullptr, nullptr},
      {"a full queue loses nothing", judged<a_full_queue_loses_nothing>, nullptr, nullptr, nullptr},
      {"what has no room asks again", judged<what_has_no_room_asks_again>, nullptr, nullptr, nullptr},
      {"a key is held until it is let go", judged<a_key_is_held_until_it_is_let_go>, nullptr, nullptr,
       nullptr},
      {"no key is held once it is unplugged", judged<no_key_is_held_once_it_is_unplugged>, nullptr, nullptr,
       nullptr},
      {"one that is not there is told", judged<one_that_is_not_there_is_told>, nullptr, nullptr, nullptr},
      {"a missing right is told", judged<a_missing_right_is_told>, nullptr, nullptr, nullptr},
      {"one that somebody else has is told", judged<one_that_somebody_else_has_is_told>, nullptr, nullptr,
       nullptr},
  };
  return cmocka_run_group_tests_name(driver, tests, nullptr, nullptr);
}

}  // namespace flexrf
