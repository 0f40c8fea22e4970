#include "hal/gripper/robotiq/robotiq_control.hpp"

#include <cstring>

#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;
using namespace flexrf::robotiq;

constexpr Time start{std::chrono::seconds(1)};
constexpr Duration cycle = std::chrono::milliseconds(10);

// The bytes of the protocol sheet: activate 0100 0000 0000, go to half way 0900 0080 FF20.
void actions_are_coded_as_the_manual_has_them(void**) {
  const Words activate = encode(Action{.activate = true});
  assert_int_equal(activate[0], 0x0100);
  assert_int_equal(activate[1], 0);
  assert_int_equal(activate[2], 0);
  const Action go{.activate = true, .go = true, .position = 0x80, .speed = 0xFF, .force = 0x20};
  const Words words = encode(go);
  assert_int_equal(words[0], 0x0900);
  assert_int_equal(words[1], 0x0080);
  assert_int_equal(words[2], 0xFF20);
  assert_true(action_in(words) == go);
}

void statuses_are_decoded_as_the_manual_has_them(void**) {
  // gOBJ 2, gSTA 3, gGTO 1, gACT 1; gFLT 0x0E, gPR 0xFF; gPO 0xBD, gCU 0x0A.
  const Told told = decode({0xB900, 0x0EFF, 0xBD0A});
  assert_true(told.is_active() && told.go && told.found == Found::while_closing);
  assert_int_equal(told.fault, 0x0E);
  assert_int_equal(told.requested, 0xFF);
  assert_int_equal(told.position, 0xBD);
  assert_int_equal(told.current, 0x0A);
  const Words words = encode(told);
  assert_int_equal(words[0], 0xB900);
  assert_int_equal(words[1], 0x0EFF);
  assert_int_equal(words[2], 0xBD0A);
}

void every_fault_has_words(void**) {
  for (const std::uint8_t silent : {std::uint8_t{0x00}, std::uint8_t{0x05}, std::uint8_t{0x07}})
    assert_string_equal(describe_fault(silent), "");
  for (std::uint8_t fault = 0x08; fault <= 0x0F; ++fault)
    assert_true(std::strlen(describe_fault(fault)) > 20);
}

Told active_at(std::uint8_t position) {
  return {.activate = true,
          .go = true,
          .activation = Activation::active,
          .found = Found::nothing,
          .requested = position,
          .position = position};
}

// It says that it found nothing, of the way before, until its echo is that of the new goal.
void what_it_found_before_is_not_taken_for_the_new_goal(void**) {
  Control control;
  control.begin({});
  Time now = start;
  control.receive(active_at(0), true, now += cycle, "");
  control.command({.opening = 0});
  assert_true(control.action() && control.action()->position == 255);
  control.receive(active_at(0), false, now += cycle, "");
  assert_true(control.state()->moving);
  control.receive(active_at(0), true, now += cycle, "");
  assert_true(control.state()->moving);
  Told closing = active_at(0);
  closing.requested = 255;
  closing.found = Found::moving;
  control.receive(closing, true, now += cycle, "");
  assert_true(control.state()->moving);
  closing.found = Found::while_closing;
  closing.position = 120;
  control.receive(closing, true, now += cycle, "");
  assert_false(control.state()->moving);
  assert_true(control.state()->object == GripperObject::gripped);
}

struct Closing {
  Closing() {
    control.begin({});
    control.receive(active_at(3), true, now += cycle, "");
    control.command({.opening = 0});
    told = active_at(3);
    told.requested = 255;
  }
  void tell(Found found, std::uint8_t position) {
    told.found = found;
    told.position = position;
    control.receive(told, true, now += cycle, "");
  }
  bool is_moving() const { return control.state()->moving; }
  GripperObject object() const { return control.state()->object; }

  Control control;
  Time now = start;
  Told told;
};

// The echo is the new goal's already, and gOBJ that of the way before.
void where_the_fingers_are_has_to_bear_out_what_is_told(void**) {
  Closing closing;
  for (int i = 0; i < 100; ++i) closing.tell(Found::nothing, 3);
  assert_true(closing.is_moving());  // it says that it is there, and it is not
  closing.tell(Found::moving, 60);
  closing.tell(Found::while_closing, 120);
  assert_false(closing.is_moving());
  assert_int_equal(closing.object(), GripperObject::gripped);
}

void what_nothing_bears_out_is_told_when_the_time_is_over(void**) {
  Closing closing;
  for (int i = 0; i < 400; ++i) closing.tell(Found::nothing, 3);
  assert_false(closing.control.trouble().is_ok());
  assert_non_null(std::strstr(closing.control.trouble().cause(), "did not come to rest"));
  assert_true(closing.control.action() && !closing.control.action()->go);
}

// A 2F-85 that is sent to 255 ends near 228, where its fingers meet.
void fingers_that_meet_before_the_goal_have_arrived(void**) {
  Closing seen;
  seen.tell(Found::moving, 60);
  seen.tell(Found::nothing, 228);
  assert_false(seen.is_moving());
  assert_int_equal(seen.object(), GripperObject::none);
  Closing unseen;  // too quick to be seen on its way
  unseen.tell(Found::nothing, 228);
  assert_true(unseen.is_moving());
  for (int i = 0; i < 31; ++i) unseen.tell(Found::nothing, 228);
  assert_false(unseen.is_moving());
}

// When it opens, gOBJ is still "gripped" for a moment.
void what_was_gripped_is_not_taken_for_what_is_met_when_it_opens(void**) {
  Control control;
  control.begin({});
  Told told = active_at(120);
  told.requested = 255;
  told.found = Found::while_closing;
  Time now = start;
  control.receive(told, true, now += cycle, "");
  control.command({.opening = 0.085});
  told.requested = 0;
  control.receive(told, true, now += cycle, "");
  assert_true(control.state()->moving);
  assert_int_equal(control.state()->object, GripperObject::unknown);
  told.found = Found::nothing;
  told.position = 2;
  control.receive(told, true, now += cycle, "");
  assert_false(control.state()->moving);
  assert_int_equal(control.state()->object, GripperObject::none);
  // More force at the same object: it is held, and the fingers do not move.
  told.position = 120;
  told.requested = 255;
  told.found = Found::while_closing;
  control.command({.opening = 0, .force = 200});
  control.receive(told, true, now += cycle, "");
  assert_false(control.state()->moving);
  assert_int_equal(control.state()->object, GripperObject::gripped);
}

// One that somebody else led holds what it holds; nothing is said to it before it is commanded.
void a_gripper_that_holds_something_is_left_as_it_is(void**) {
  Control control;
  control.begin({});
  Told holding = active_at(100);
  holding.requested = 255;
  holding.found = Found::while_closing;
  control.receive(holding, true, start + cycle, "");
  control.halt();
  assert_false(control.action().has_value());
  assert_true(control.state()->activated && control.state()->holds_object());
}

void one_that_moves_when_it_is_met_can_be_halted(void**) {
  Control control;
  control.begin({});
  Told moving = active_at(100);
  moving.found = Found::moving;
  control.receive(moving, true, start + cycle, "");
  assert_true(control.state()->moving);
  control.halt();
  assert_true(control.action() && control.action()->activate && !control.action()->go);
  assert_false(control.is_at_rest());
  moving.go = false;
  control.receive(moving, true, start + 2 * cycle, "");
  assert_true(control.is_at_rest());
}

// rACT has to rise; after a fault it is taken away first.
void activation_takes_the_bit_away_and_gives_it_again(void**) {
  Control control;
  control.begin({});
  Told faulted = active_at(0);
  faulted.fault = 0x0D;
  Time now = start;
  control.receive(faulted, true, now += cycle, "");
  assert_false(control.state()->activated);
  assert_int_equal(control.trouble().code(), StatusCode::device_fault);
  assert_non_null(std::strstr(control.trouble().cause(), "0x0D"));
  control.activate();
  assert_true(control.action() && !control.action()->activate);
  control.receive(Told{}, true, now += cycle, "");
  assert_true(control.action()->activate);
  control.receive(Told{.activate = true, .activation = Activation::activating}, true, now += cycle, "");
  assert_true(control.state()->moving);
  Told done = active_at(0);
  done.go = false;
  control.receive(done, true, now += cycle, "");
  assert_true(control.state()->activated && !control.state()->moving && control.trouble().is_ok());
}

void an_activation_that_does_not_end_is_given_up(void**) {
  Control control;
  control.begin({.activation_timeout = std::chrono::seconds(2)});
  Time now = start;
  control.receive(Told{}, true, now, "");
  control.activate();
  assert_true(control.action()->activate);
  const Told activating{.activate = true, .activation = Activation::activating};
  for (int i = 0; i < 210; ++i) control.receive(activating, true, now += cycle, "");
  assert_int_equal(control.trouble().code(), StatusCode::timeout);
  assert_false(control.action()->activate);
  assert_false(control.state()->moving);
}

// A short dip of its supply, that no request met: its registers are 0 again.
void a_reset_by_itself_is_told_and_nothing_is_repeated(void**) {
  Control control;
  control.begin({});
  Time now = start;
  control.receive(active_at(0), true, now += cycle, "");
  control.command({.opening = 0});
  assert_true(control.take_anew());
  control.receive(Told{}, true, now += cycle, "");
  assert_false(control.action().has_value());
  assert_int_equal(control.trouble().code(), StatusCode::device_fault);
  control.command({.opening = 0});
  assert_false(control.action().has_value());
  control.activate();
  assert_true(control.take_anew());
}

void silence_is_told_with_its_reason(void**) {
  Control control;
  control.begin({});
  control.receive(active_at(0), true, start + cycle, "");
  control.command({.opening = 0});
  control.receive(std::nullopt, false, start + 2 * cycle, "no whole answer");
  assert_false(control.state().has_value());
  assert_false(control.action().has_value());
  assert_int_equal(control.trouble().code(), StatusCode::unavailable);
  assert_non_null(std::strstr(control.trouble().cause(), "no whole answer"));
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(actions_are_coded_as_the_manual_has_them),
      cmocka_unit_test(statuses_are_decoded_as_the_manual_has_them),
      cmocka_unit_test(every_fault_has_words),
      cmocka_unit_test(what_it_found_before_is_not_taken_for_the_new_goal),
      cmocka_unit_test(where_the_fingers_are_has_to_bear_out_what_is_told),
      cmocka_unit_test(what_nothing_bears_out_is_told_when_the_time_is_over),
      cmocka_unit_test(fingers_that_meet_before_the_goal_have_arrived),
      cmocka_unit_test(what_was_gripped_is_not_taken_for_what_is_met_when_it_opens),
      cmocka_unit_test(a_gripper_that_holds_something_is_left_as_it_is),
      cmocka_unit_test(one_that_moves_when_it_is_met_can_be_halted),
      cmocka_unit_test(activation_takes_the_bit_away_and_gives_it_again),
      cmocka_unit_test(an_activation_that_does_not_end_is_given_up),
      cmocka_unit_test(a_reset_by_itself_is_told_and_nothing_is_repeated),
      cmocka_unit_test(silence_is_told_with_its_reason),
  };
  return cmocka_run_group_tests_name("Robotiq control", tests, nullptr, nullptr);
}
